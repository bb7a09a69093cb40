"""Where a point over the scenario's tangent plane is on the globe."""

from typing import Any

import numpy as np
import numpy.typing as npt

EARTH_RADIUS = 6.371e6  # [m], mean; of the drop of the ground below the plane

Origin = tuple[float, float, float]  # latitude, longitude [deg], altitude [m]


def over_the_ground(
    north: npt.ArrayLike, east: npt.ArrayLike, altitude: npt.ArrayLike, origin: Origin
) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
    """Latitude and longitude [deg] of points over the plane that touches WGS 84 at `origin`.

    Args:
        north, east: (rows,) or numbers, on the plane [m].
        altitude: of the points [m]; the ground falls away below the plane, so it is lower over the plane.
        origin: where the plane touches.
    """
    from pymap3d.enu import enu2geodetic

    x, y, height = np.asarray(east), np.asarray(north), np.asarray(altitude)
    up = height - origin[2] - (y * y + x * x) / (2.0 * EARTH_RADIUS)
    latitude, longitude, _ = enu2geodetic(x, y, up, *origin)
    return np.asarray(latitude), np.asarray(longitude)
