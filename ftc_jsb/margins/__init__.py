"""Gain, phase and delay margins of the outer loop at its three inputs, measured in flight."""
