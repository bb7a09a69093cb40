"""Campaigns: a scenario flown many times with dispersed parameters, here or on a cluster."""
