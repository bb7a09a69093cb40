"""The published criteria of docs/aircraft.md for an inner loop, and whether flown steps meet them."""

import math

from ftc_jsb.inner_loop_design.published_steps import NEAR, Steps

LOAD_FACTOR_RISE = 0.6  # [s], 10 to 90 %
LOAD_FACTOR_OVERSHOOT = 0.10  # of the step
LOAD_FACTOR_ERROR = 0.01  # of the step
BANK_SETTLING = 2.0  # [s] to 5 %
BANK_OVERSHOOT = 0.05  # of the step
TURN_SIDESLIP_DEG = 0.5  # [deg], in a steady turn


def criteria_met(steps: Steps) -> bool:
    """Whether every criterion of docs/aircraft.md holds at this airspeed."""
    pulled, rolled = steps.load_factor_response, steps.bank_response
    return (
        pulled.rise <= LOAD_FACTOR_RISE
        and pulled.overshoot <= LOAD_FACTOR_OVERSHOOT
        and pulled.error <= LOAD_FACTOR_ERROR
        and rolled.settling <= BANK_SETTLING
        and rolled.overshoot <= BANK_OVERSHOOT
        and math.degrees(steps.turn_sideslip) <= TURN_SIDESLIP_DEG
        and steps.thrust_error <= NEAR
    )
