"""Dynamic pressure times area in the standard atmosphere, of recorded flight."""

from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from ftc_jsb.point_mass.atmosphere import standard_atmosphere

Array = npt.NDArray[np.float64]
Number = TypeVar("Number", float, Array)


def density_at(altitude: Array) -> Array:
    """Density of the standard atmosphere [kg/m^3] at altitudes [m]; (samples,) in and out."""
    return np.array([standard_atmosphere(height)[0] for height in altitude])


def pressure_area(density: Number, airspeed: Number, area: float) -> Number:
    """Dynamic pressure times area, 1/2 rho V^2 S [N].

    Args:
        density: of the air [kg/m^3].
        airspeed: [m/s], one or (samples,) as the density.
        area: reference area [m^2].
    """
    return 0.5 * density * airspeed**2 * area


def greatest_lift(row: Any, area: float, lift_coefficient_max: float) -> float:
    """Lift [N] at the greatest lift coefficient, at the altitude and airspeed of a recorded row.

    Args:
        row: of a recording.
        area: reference area [m^2].
        lift_coefficient_max: of the aircraft.
    """
    density, _ = standard_atmosphere(float(row["altitude"]))
    return pressure_area(density, float(row["airspeed"]), area) * lift_coefficient_max
