"""What is flown and asked of an inner loop, by the class of the airplane."""

import math
from typing import NamedTuple

from ftc_jsb.aircraft.airplane_class import airplane_class
from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.six_dof.data_sheet import data_sheet

MOST_STEP = 3.0  # load factor
STEP_SHARE = 0.4  # of the aircraft's load factor range above 1, where that is less


class Handling(NamedTuple):
    """Steps and criteria of a class.

    Bank angles and times are those of MIL-F-8785C 3.3.4, level 1, category B, twice the time to
    the angle: as long again to stop there. Class IV has the 2 s of the fighters instead. Aircraft that
    slow down in a pull, as all but fighters do, are asked for less of what they can pull at its start;
    and the slower the flight, the more sideslip comes with the same sideways speed.
    """

    bank_step: float  # [rad]
    steep_turn: float  # [rad], bank of the steady turn
    bank_settling: float  # [s] to 5 % of the step
    load_factor_rise: float  # [s], 10 to 90 %
    # [rad/s], tried in this order, down to where the rise would take too long
    load_factor_frequencies: tuple[float, ...]
    bank_frequencies: tuple[float, ...]  # [rad/s]
    thrust_times: tuple[float, float, float]  # [s]: idle until, full until, idle again until
    step_time: float  # [s] of the search's flights
    roll_sideslip: float  # [rad] in a bank step of the search
    # Dynamic pressure from which load factor is fed back in full, of the least that is designed for.
    # The tail's own lift, which goes the wrong way first, weighs the more the less pressure there is.
    full_pressure: float
    pull_share: float  # of what the aircraft can pull, at most in a load factor step


CLASSES = {
    "I": Handling(
        math.radians(60.0), math.radians(60.0), 3.4, 0.9,
        (6.0, 5.0, 4.5, 4.0, 3.5, 3.0), (6.0, 5.0, 4.5, 4.0, 3.5, 3.0, 2.5, 2.0, 1.5),
        (6.0, 21.0, 31.0), 5.0, 0.05, 1.3, 0.6,
    ),
    "II": Handling(
        math.radians(45.0), math.radians(45.0), 3.8, 1.2,
        (4.5, 4.0, 3.5, 3.0, 2.5, 2.0), (4.0, 3.5, 3.0, 2.5, 2.0, 1.5, 1.2),
        (6.0, 26.0, 36.0), 7.0, 0.05, 1.3, 0.6,
    ),
    "III": Handling(
        math.radians(30.0), math.radians(45.0), 4.6, 1.6,
        (3.5, 3.0, 2.5, 2.0, 1.5), (3.0, 2.5, 2.0, 1.5, 1.2, 1.0),
        (6.0, 26.0, 36.0), 7.0, 0.05, 1.3, 0.6,
    ),
    "IV": Handling(
        math.radians(60.0), math.radians(70.0), 2.0, 0.6,
        # from a quarter of the inversion bandwidth down
        (9.0, 8.0, 7.0, 6.0, 5.0, 4.5, 4.0, 3.5, 3.0),
        (8.0, 7.0, 6.0, 5.0, 4.5, 4.0, 3.5, 3.0, 2.5, 2.0),
        (3.0, 9.0, 13.0), 5.0, 0.03, 2.6, 0.8,
    ),
}  # fmt: skip


def class_of(aircraft: Aircraft) -> str:
    """Class of an aircraft: that of its file, or by mass and load factor.

    Raises:
        AircraftError: it cannot be woven or loaded.
    """
    if aircraft.airplane_class is not None:
        return aircraft.airplane_class
    sheet = data_sheet(aircraft)
    mass = sheet.empty_mass + 0.5 * sheet.fuel_capacity
    return airplane_class(mass, aircraft.flight_test.load_factor[1])


def largest_step(aircraft: Aircraft) -> float:
    """Load factor of the published step: 3, or less for an aircraft that is not flown to as much."""
    return min(MOST_STEP, 1.0 + STEP_SHARE * (aircraft.flight_test.load_factor[1] - 1.0))
