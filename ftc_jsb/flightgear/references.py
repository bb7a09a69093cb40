"""References of a flight in another program: the scenario's, the pilot's, and smoothly from one to the other.

When the outer loop takes over, and when the pilot gives back, the raw commands begin at what is flown and
go to the scenario's at bounded rates: nothing jumps.
"""

import math
from typing import NamedTuple

from ftc_jsb.units import STANDARD_GRAVITY

RATES = (
    5.0,
    math.radians(1.0),
    math.radians(2.0),
)  # [m/s^2], [rad/s], [rad/s] towards the scenario's

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
        self._offset = [0.0, 0.0, 0.0]
        self._heading = 0.0  # of the pilot
        self._last: Triple = (0.0, 0.0, 0.0)
        self.piloted = False

    def begin_at(self, flown: Triple, planned: Triple) -> None:
        """Start from what is flown, on the way to what is planned."""
        self._offset = [a - b for a, b in zip(flown, planned, strict=True)]
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
            if not self.piloted:
                self._heading = self._last[2]
            turn = STANDARD_GRAVITY * math.tan(pilot.bank_angle) / max(pilot.airspeed, 50.0)
            self._heading += step * turn
            self._last = (pilot.airspeed, pilot.flight_path_angle, self._heading)
        else:
            if self.piloted:
                self._offset = [a - b for a, b in zip(self._last, planned, strict=True)]
            for k, rate in enumerate(RATES):
                left = abs(self._offset[k]) - rate * step
                self._offset[k] = math.copysign(max(left, 0.0), self._offset[k])
            airspeed, path, heading = (a + b for a, b in zip(planned, self._offset, strict=True))
            self._last = (airspeed, path, heading)
        self.piloted = pilot.has
        return self._last
