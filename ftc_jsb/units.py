"""Exact conversion factors at the edges: multiply to get SI."""

FOOT = 0.3048  # [m]
POUND_MASS = 0.45359237  # [kg]
STANDARD_GRAVITY = 9.80665  # [m/s^2]
POUND_FORCE = POUND_MASS * STANDARD_GRAVITY  # [N]
