"""From the tangent plane of the scenario to the globe."""

import math
from functools import lru_cache

from ftc_jsb.analysis.geodesy import Origin as Origin
from ftc_jsb.analysis.geodesy import over_the_ground


@lru_cache(maxsize=1)  # several messages of one sample ask
def latitude_longitude(
    north: float, east: float, altitude: float, origin: Origin
) -> tuple[float, float]:
    """Latitude and longitude [deg] of a point over the plane that touches WGS 84 at `origin`.

    Args:
        north, east: on the plane [m].
        altitude: of the point [m]; the plane leaves the ellipsoid, so it is lower over the plane.
        origin: where the plane touches.
    """
    if not math.isfinite(north + east + altitude):
        return origin[:2]
    latitude, longitude = over_the_ground(north, east, altitude, origin)
    return float(latitude), float(longitude)
