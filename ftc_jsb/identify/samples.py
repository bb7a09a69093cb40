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
    path_rate: Array  # of the velocity in the plane of symmetry, over V
    side: Array  # C_Y along the body's y axis
    aileron: Array
    rudder: Array
    roll_rate: Array  # p / V
    yaw_rate: Array  # r / V
    share: Array  # that a sample counts in the fits of drag and lift


def samples(records: list[npt.NDArray[Any]], area: float, share: float = 1.0) -> Samples:
    """Aerodynamic coefficients along test flights, every 5th sample after the first 0.2 s.

    Args:
        records: (rows,) of each flight.
        area: reference area [m^2].
        share: that each of them counts.
    """
    rows = np.concatenate([record[20::5] for record in records])
    force = pressure_area(density_at(rows["altitude"]), rows["airspeed"], area)
    weight = rows["mass"] * STANDARD_GRAVITY
    airspeed = rows["airspeed"]
    turning = rows["load_factor"] - np.cos(rows["flight_path_angle"]) * np.cos(rows["bank_angle"])
    return Samples(
        (rows["load_factor"] * weight - rows["thrust"] * np.sin(rows["alpha"])) / force,
        rows["drag"] / force,
        rows["mach"],
        rows["alpha"],
        rows["sideslip"],
        rows["elevator"],
        rows["flap"],
        rows["pitch_rate"] / airspeed,
        STANDARD_GRAVITY * turning / airspeed**2,
        rows["load_factor_y"] * weight / force,
        rows["aileron"],
        rows["rudder"],
        rows["roll_rate"] / airspeed,
        rows["yaw_rate"] / airspeed,
        np.full(len(rows), share),
    )


def joined(*parts: Samples) -> Samples:
    """The samples of all parts."""
    return Samples(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))


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
