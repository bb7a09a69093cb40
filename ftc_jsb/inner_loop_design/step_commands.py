"""Commands of the step flights: load factor, bank, a steep turn, thrust."""

import math
from typing import Any

from ftc_jsb.aircraft.dynamic_pressure import greatest_lift
from ftc_jsb.six_dof.commanded_flight import Commands
from ftc_jsb.units import STANDARD_GRAVITY

START = 1.0  # [s] of steady flight before a step
RAMP_RATE = 0.8  # [1/s] of load factor
BEYOND_ANY_ENGINE = 1e6  # [N]


def load_factor_step(most: float) -> Commands:
    """1 to `most` at START, wings level."""

    def commands(time: float, row: Any) -> tuple[float, float, float]:
        return math.nan, (most if time >= START else 1.0), 0.0

    return commands


def bank_step(bank: float) -> Commands:
    """0 to `bank` [rad] at START, load factor keeping the height."""

    def commands(time: float, row: Any) -> tuple[float, float, float]:
        load_factor = 1.0 / math.cos(min(abs(float(row["bank_angle"])), 1.1))
        return math.nan, load_factor, bank if time >= START else 0.0

    return commands


def steep_turn(bank: float) -> Commands:
    """A level turn at `bank` [rad]."""

    def commands(time: float, row: Any) -> tuple[float, float, float]:
        return math.nan, 1.0 / math.cos(bank), bank

    return commands


def most_pulled(lift_coefficient_max: float, area: float, row: Any) -> float:
    """Load factor that an aircraft can pull at a flight condition.

    Args:
        lift_coefficient_max: of the aircraft.
        area: reference area [m^2].
        row: of a recording, at the flight condition.
    """
    lift = greatest_lift(row, area, lift_coefficient_max)
    return lift / (float(row["mass"]) * STANDARD_GRAVITY)


def ramp(time: float, row: Any) -> tuple[float, float, float]:
    """Load factor rising until the aircraft cannot follow, or past what the step needs, wings level."""
    return math.nan, 1.0 + RAMP_RATE * time, 0.0


def thrust_steps(times: tuple[float, float, float]) -> Commands:
    """Idle, full and idle again, each until its time [s]: far below the one, far above the other."""

    def commands(time: float, row: Any) -> tuple[float, float, float]:
        full = times[0] <= time < times[1]
        return (
            (BEYOND_ANY_ENGINE if full else -BEYOND_ANY_ENGINE),
            math.cos(float(row["flight_path_angle"])),
            0.0,
        )

    return commands
