"""References of a flight in another program: the scenario's, the pilot's, and smoothly from one to the other.

When the outer loop takes over, and when the pilot gives back, the raw commands begin at what is flown and
go to the scenario's at bounded rates: nothing jumps.
"""

import math
from typing import NamedTuple

from ftc_jsb.units import STANDARD_GRAVITY

RATES = (
    3.0,
    math.radians(1.0),
    math.radians(1.5),
)  # [m/s^2], [rad/s], [rad/s] towards the scenario's
BENDS = (
    1.5,
    math.radians(0.5),
    math.radians(1.0),
)  # [m/s^3], [rad/s^2]: of how fast that begins and ends

SLOWEST = 50.0  # [m/s], for a turn by bank

Triple = tuple[float, float, float]  # airspeed [m/s], flight path angle, heading [rad]


class Pilot(NamedTuple):
    """The pilot's references, as a line has them."""

    has: bool  # whether they count
    airspeed: float  # [m/s]
    flight_path_angle: float  # [rad]
    bank_angle: float  # [rad]


class References:
    """Raw commands of a sample, before the command filter."""

    def __init__(self) -> None:
        """The scenario's, from the first `begin_at` on."""
        self._offset, self._slope = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
        self._heading = 0.0  # of the pilot
        self._last: Triple = (0.0, 0.0, 0.0)
        self.piloted = False

    def begin_at(self, flown: Triple, planned: Triple) -> None:
        """Start from what is flown, on the way to what is planned."""
        self._offset = [a - b for a, b in zip(flown, planned, strict=True)]
        self._slope = [0.0, 0.0, 0.0]
        self._last = flown
        self.piloted = False

    def raw(self, planned: Triple, pilot: Pilot, step: float) -> Triple:
        """Commands now.

        Args:
            planned: by the scenario and the ground station.
            pilot: as the line has it.
            step: simulation time since the sample before [s].
        """
        if pilot.has:
            self._follow(pilot, planned, step)
        else:
            self._return(step)
            airspeed, path, heading = (a + b for a, b in zip(planned, self._offset, strict=True))
            self._last = (airspeed, path, heading)
        self.piloted = pilot.has
        return self._last

    def _follow(self, pilot: Pilot, planned: Triple, step: float) -> None:
        """The pilot's references; how far they are from the scenario's, and how fast that changes."""
        if not self.piloted:
            self._heading = self._last[2]
        turn = STANDARD_GRAVITY * math.tan(pilot.bank_angle) / max(pilot.airspeed, SLOWEST)
        self._heading += step * turn
        self._last = (pilot.airspeed, pilot.flight_path_angle, self._heading)
        offset = [a - b for a, b in zip(self._last, planned, strict=True)]
        if self.piloted and step > 0.0:
            self._slope = [(a - b) / step for a, b in zip(offset, self._offset, strict=True)]
        self._offset = offset

    def _return(self, step: float) -> None:
        """The offset goes to zero, and its slope to that of the way there, both at bounded rates."""
        for k, (rate, bend) in enumerate(zip(RATES, BENDS, strict=True)):
            left = self._offset[k]
            wanted = -math.copysign(min(rate, math.sqrt(bend * abs(left))), left)
            change = min(max(wanted - self._slope[k], -bend * step), bend * step)
            self._slope[k] += change
            moved = left + step * self._slope[k]
            arrived = abs(left) < bend * step * step and abs(self._slope[k]) <= bend * step
            if arrived or (left * moved < 0.0 and abs(self._slope[k]) < 4.0 * bend * step):
                moved, self._slope[k] = 0.0, 0.0
            self._offset[k] = moved
