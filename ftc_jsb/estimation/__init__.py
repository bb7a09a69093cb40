"""Filters and the fault detector."""
