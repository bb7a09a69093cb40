"""Positions over the tangent plane on the globe."""

import math

import pytest

from ftc_jsb.mavlink.telemetry.geodesy import latitude_longitude


@pytest.mark.parametrize("model", ["paper", "jsbsim"])
def test_position_on_the_globe_is_jsbsims(flown, model):
    """The tangent plane's point as latitude and longitude: as far from the origin as it was flown.

    60 s at 300 m/s: the haversine distance on JSBSim's ellipsoid within 0.4 %, and the bearing 0.3 deg.
    """
    flight = flown("paper", f"model={model}")
    i = flight.record.size - 1
    row = flight.record[i]
    origin = (47.0, 8.0, 3048.0)
    latitude, longitude = latitude_longitude(row["north"], row["east"], row["altitude"], origin)
    north = math.radians(latitude - 47.0) * 6.3715e6  # [m] a radian at 47 deg
    east = math.radians(longitude - 8.0) * 6.3895e6 * math.cos(math.radians(47.0))
    assert math.hypot(north, east) == pytest.approx(math.hypot(row["north"], row["east"]), rel=4e-3)
    assert math.atan2(east, north) == pytest.approx(math.atan2(row["east"], row["north"]), abs=5e-3)
