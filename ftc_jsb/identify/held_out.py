"""How well the fitted point mass tells flights that no fit has seen: relative residuals."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.aircraft.dynamic_pressure import density_at
from ftc_jsb.identify.angles_drag import AnglesDrag
from ftc_jsb.identify.measured_lift import MeasuredLift
from ftc_jsb.identify.polar import Polar
from ftc_jsb.identify.regression import Array
from ftc_jsb.identify.samples import between_knots, relative_residual, samples
from ftc_jsb.identify.side_force import SideForce
from ftc_jsb.identify.thrust_deck import Deck
from ftc_jsb.point_mass.model import MODEL
from ftc_jsb.point_mass.thrust import spool_rate
from ftc_jsb.six_dof.commanded_flight import DT

FIRST = 20  # samples of a flight that are left out: out of a trim JSBSim's rotors jump


class DragResiduals(NamedTuple):
    """(C_D predicted - C_D flown) / C_D flown; (samples,) each."""

    polar: Array  # with the part of sideslip
    polar_without_sideslip: Array
    angles: Array
    beyond: float  # share of the samples beyond the polar's range, which are left out


def drag_residuals(
    records: list[npt.NDArray[Any]], area: float, polar: Polar, angles: AnglesDrag
) -> DragResiduals:
    """Of the drag by the polar and by measured angles, where the loop does not call it extrapolated.

    Args:
        records: flights that were not fitted to.
        area: reference area [m^2].
        polar: as fitted.
        angles: as fitted.
    """
    flown = samples(records, area)
    check = between_knots(flown, polar.mach)
    return DragResiduals(
        relative_residual(polar.predict(check) + angles.of_sideslip(check), check),
        relative_residual(polar.predict(check), check),
        relative_residual(angles.predict(check), check),
        1.0 - len(check.mach) / len(flown.mach),
    )


def lift_residual(records: list[npt.NDArray[Any]], area: float, lift: MeasuredLift) -> Array:
    """C_L predicted - C_L flown, within the Mach range of the fit.

    Args:
        records: flights that were not fitted to.
        area: reference area [m^2].
        lift: as fitted.
    """
    check = between_knots(samples(records, area), lift.mach)
    return lift.predict(check) - check.lift


def side_force_residual(records: list[npt.NDArray[Any]], area: float, side: SideForce) -> Array:
    """Sideslip that the side force tells less the true one [rad], within the Mach range of the fit.

    Args:
        records: flights that were not fitted to.
        area: reference area [m^2].
        side: as fitted.
    """
    check = between_knots(samples(records, area), side.mach)
    return (check.side - side.predict(check)) / side.slope(check)


def thrust_residual(
    records: list[npt.NDArray[Any]], deck: Deck, spool_up: Array, spool_down: Array
) -> Array:
    """(Thrust from throttle through deck and spool - thrust flown) / maximum thrust.

    Args:
        records: flights that were not fitted to.
        deck: as fitted.
        spool_up: (3,) coefficients of `thrust.spool_rate`.
        spool_down: (3,) likewise.
    """
    model = np.zeros(1, MODEL)
    model[0]["spool_up"], model[0]["spool_down"] = spool_up, spool_down
    residuals = []
    for record in (whole[FIRST:] for whole in records):
        idle, military, maximum = deck.levels(record)
        speed = np.clip(record["throttle"], 0.0, 1.0)
        at_first = (record["thrust"][0] - idle[0]) / (military[0] - idle[0])
        speed[0] = np.sqrt(np.clip(at_first, 0.0, 1.0))  # what thrust tells of it there
        density = density_at(record["altitude"])
        for i in range(1, record.size):
            up = bool(speed[i] > speed[i - 1])
            most = spool_rate(model[0], speed[i - 1], density[i], up) * DT
            speed[i] = speed[i - 1] + np.clip(speed[i] - speed[i - 1], -most, most)
        dry = idle + (military - idle) * speed**2
        thrust = dry + np.clip(record["throttle"] - 1.0, 0.0, 1.0) * (maximum - dry)
        residuals.append(((thrust - record["thrust"]) / maximum)[1:])
    return np.concatenate(residuals)
