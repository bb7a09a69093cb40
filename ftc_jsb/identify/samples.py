"""Samples of the test flights that the aerodynamic fits use."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.aircraft.dynamic_pressure import density_at, pressure_area
from ftc_jsb.identify.regression import Array
from ftc_jsb.units import STANDARD_GRAVITY


class Samples(NamedTuple):
    """Columns of the test flights that the fits need; (samples,) each, SI and rad."""

    lift: Array
    drag: Array  # C_D
    mach: Array
    alpha: Array
    sideslip: Array
    elevator: Array
    flap: Array
    pitch_rate: Array  # q / V


def samples(records: list[npt.NDArray[Any]], area: float) -> Samples:
    """Drag and lift coefficients along test flights, every 5th sample after the first 0.2 s.

    Args:
        records: (rows,) of each flight.
        area: reference area [m^2].
    """
    rows = np.concatenate([record[20::5] for record in records])
    force = pressure_area(density_at(rows["altitude"]), rows["airspeed"], area)
    normal = rows["load_factor"] * rows["mass"] * STANDARD_GRAVITY
    return Samples(
        (normal - rows["thrust"] * np.sin(rows["alpha"])) / force,
        rows["drag"] / force,
        rows["mach"],
        rows["alpha"],
        rows["sideslip"],
        rows["elevator"],
        rows["flap"],
        rows["pitch_rate"] / rows["airspeed"],
    )


def between_knots(data: Samples, mach: Array, lift: Array | None = None) -> Samples:
    """The samples between the outermost knots: those beyond would be laid to the charge of the ends.

    Args:
        data: samples.
        mach: knots.
        lift: knots of the lift coefficient; None: all of them.
    """
    use = (data.mach >= mach[0]) & (data.mach <= mach[-1])
    if lift is not None:
        use &= (data.lift >= lift[0]) & (data.lift <= lift[-1])
    return Samples(*(column[use] for column in data))


def relative_residual(predicted: Array, data: Samples) -> Array:
    """(C_D predicted - C_D flown) / C_D flown."""
    return (predicted - data.drag) / data.drag
