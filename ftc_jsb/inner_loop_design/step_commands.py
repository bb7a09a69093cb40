"""Commands of the step flights: load factor, bank, a steep turn, thrust."""

import math
from typing import Any

from ftc_jsb.aircraft.dynamic_pressure import greatest_lift
from ftc_jsb.six_dof.commanded_flight import Commands
from ftc_jsb.units import STANDARD_GRAVITY

START = 1.0  # [s] of steady flight before a step
MOST_STEP = 3.0  # load factor
SHARE_OF_PULL = 0.8  # of what an aircraft can pull, where that is less than 3
BANK_STEP = math.radians(60.0)
STEEP = math.radians(70.0)
RAMP_RATE = 0.8  # [1/s] of load factor
THRUST_TIMES = (3.0, 9.0, 13.0)  # [s]: idle until, full until, idle again until
BEYOND_ANY_ENGINE = 1e6  # [N]


def load_factor_step(most: float) -> Commands:
    """1 to `most` at START, wings level."""

    def commands(time: float, row: Any) -> tuple[float, float, float]:
        return math.nan, (most if time >= START else 1.0), 0.0

    return commands


def bank_step(time: float, row: Any) -> tuple[float, float, float]:
    """0 to 60 deg at START, load factor keeping the height."""
    load_factor = 1.0 / math.cos(min(abs(float(row["bank_angle"])), 1.1))
    return math.nan, load_factor, BANK_STEP if time >= START else 0.0


def steep_turn(time: float, row: Any) -> tuple[float, float, float]:
    """A level turn at 70 deg of bank."""
    return math.nan, 1.0 / math.cos(STEEP), STEEP


def pull(lift_coefficient_max: float, area: float, row: Any) -> float:
    """Load factor of the step: 3, or 80 % of what the aircraft can pull at the flight condition.

    Args:
        lift_coefficient_max: of the aircraft.
        area: reference area [m^2].
        row: of a recording, at the flight condition.
    """
    lift = greatest_lift(row, area, lift_coefficient_max)
    return min(MOST_STEP, SHARE_OF_PULL * lift / (float(row["mass"]) * STANDARD_GRAVITY))


def ramp(time: float, row: Any) -> tuple[float, float, float]:
    """Load factor rising until the aircraft cannot follow, or past what the step needs, wings level."""
    return math.nan, 1.0 + RAMP_RATE * time, 0.0


def thrust_steps(time: float, row: Any) -> tuple[float, float, float]:
    """Idle, full and idle again: far below the one, far above the other."""
    full = THRUST_TIMES[0] <= time < THRUST_TIMES[1]
    return (
        (BEYOND_ANY_ENGINE if full else -BEYOND_ANY_ENGINE),
        math.cos(float(row["flight_path_angle"])),
        0.0,
    )
