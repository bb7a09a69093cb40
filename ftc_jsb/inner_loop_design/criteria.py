"""The published criteria of docs/aircraft.md for an inner loop, and which of them flown steps miss."""

import math

from ftc_jsb.inner_loop_design.handling import Handling
from ftc_jsb.inner_loop_design.published_steps import NEAR, Steps

LOAD_FACTOR_OVERSHOOT = 0.10  # of the step
LOAD_FACTOR_ERROR = 0.01  # of the step
BANK_OVERSHOOT = 0.05  # of the step
TURN_SIDESLIP_DEG = 0.5  # [deg], in a steady turn


def criteria_missed(steps: Steps, handling: Handling) -> list[str]:
    """What is not kept at this airspeed, with the figure and the limit.

    Args:
        steps: as flown.
        handling: what is asked of the aircraft's class.
    """
    pulled, rolled = steps.load_factor_response, steps.bank_response
    turn = math.degrees(steps.turn_sideslip)
    judged = (
        ("load factor rise", pulled.rise, handling.load_factor_rise, "s"),
        ("load factor overshoot", 100.0 * pulled.overshoot, 100.0 * LOAD_FACTOR_OVERSHOOT, "%"),
        ("load factor error", 100.0 * pulled.error, 100.0 * LOAD_FACTOR_ERROR, "%"),
        ("bank settling", rolled.settling, handling.bank_settling, "s"),
        ("bank overshoot", 100.0 * rolled.overshoot, 100.0 * BANK_OVERSHOOT, "%"),
        ("sideslip in a steady turn", turn, TURN_SIDESLIP_DEG, "deg"),
        ("thrust error", 100.0 * steps.thrust_error, 100.0 * NEAR, "%"),
    )
    return [
        f"{name} {value:.3g} {unit} against {limit:.3g} {unit}"
        for name, value, limit, unit in judged
        if not value <= limit
    ]
