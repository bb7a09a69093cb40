"""Lift and drag over angle of attack and Mach number, with the elevator where it balances the aircraft."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.draft.probe import hold, settle

Array = npt.NDArray[np.float64]

ALPHA = np.radians(np.arange(-4.0, 25.0, 1.0))
ELEVATOR = (-1.0, 0.0, 1.0)  # commands between which the balance is interpolated
SETTLED = 0.6  # [s]
ALTITUDE = 3048.0  # [m]


class TrimmedPolar(NamedTuple):
    """Coefficients of balanced flight; nan where no elevator balances it."""

    mach: Array  # (m,)
    lift: Array  # (m, n) C_L over Mach and ALPHA
    drag: Array  # (m, n) C_D

    def lift_max(self) -> Array:
        """(m,): the first peak of C_L over angle of attack, or its last balanced value; nan if none."""
        peaks = np.full(len(self.mach), math.nan)
        for i, lift in enumerate(self.lift):
            balanced = lift[np.isfinite(lift)]
            if balanced.size:
                falling = np.flatnonzero(np.diff(balanced) < 0.0)
                peaks[i] = balanced[falling[0]] if falling.size else balanced[-1]
        return peaks

    def drag_at(self, mach: float, lift: float) -> float:
        """C_D at a Mach number and C_L; nan outside what balances."""
        rows = [_drag_at(self.lift[i], self.drag[i], lift) for i in range(len(self.mach))]
        if not self.mach[0] <= mach <= self.mach[-1]:
            return math.nan
        return float(np.interp(mach, self.mach, rows))


def _drag_at(lift: Array, drag: Array, wanted: float) -> float:
    use = np.isfinite(lift)
    lift, drag = lift[use], drag[use]
    falling = np.flatnonzero(np.diff(lift) <= 0.0)
    last = falling[0] + 1 if falling.size else lift.size
    if last < 2 or not lift[0] <= wanted <= lift[last - 1]:
        return math.nan
    return float(np.interp(wanted, lift[:last], drag[:last]))


def trimmed_polar(fdm: Any, mach: Sequence[float], sound_speed: float) -> TrimmedPolar:
    """Measure it on an aircraft that is held still.

    Args:
        fdm: of `probe.loaded`, engines off.
        mach: numbers, ascending.
        sound_speed: [m/s] at ALTITUDE.

    Raises:
        AircraftError: JSBSim refuses a condition.
    """
    shape = len(ELEVATOR), len(mach), len(ALPHA)
    pitch, lift, drag = np.empty(shape), np.empty(shape), np.empty(shape)
    for e, command in enumerate(ELEVATOR):
        for m, number in enumerate(mach):
            for a, alpha in enumerate(ALPHA):
                fdm["fcs/elevator-cmd-norm"] = command
                hold(fdm, number * sound_speed, ALTITUDE, float(alpha))
                settle(fdm, SETTLED)
                force = fdm["aero/qbar-psf"] * fdm["metrics/Sw-sqft"]
                pitch[e, m, a] = fdm["accelerations/qdot-rad_sec2"]
                lift[e, m, a] = fdm["forces/fwz-aero-lbs"] / force
                drag[e, m, a] = fdm["forces/fwx-aero-lbs"] / force
    return TrimmedPolar(np.array(mach), _balanced(pitch, lift), _balanced(pitch, drag))


def _balanced(pitch: Array, values: Array) -> Array:
    """Values where the pitching acceleration is zero, between the elevator commands."""
    found = np.full(values.shape[1:], math.nan)
    for e in range(len(ELEVATOR) - 1):
        share = pitch[e] / np.where(pitch[e] == pitch[e + 1], math.nan, pitch[e] - pitch[e + 1])
        inside = (share >= 0.0) & (share <= 1.0) & np.isnan(found)
        found[inside] = ((1.0 - share) * values[e] + share * values[e + 1])[inside]
    return found
