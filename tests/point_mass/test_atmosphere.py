"""The standard atmosphere against the published tables."""

import pytest

from ftc_jsb.point_mass.atmosphere import standard_atmosphere


@pytest.mark.parametrize(
    ("altitude", "density", "sound_speed"),
    [  # U.S. Standard Atmosphere 1976, table I and III, geometric altitude
        (0.0, 1.2250, 340.29),
        (1000.0, 1.1117, 336.43),
        (5000.0, 0.73643, 320.55),
        (10000.0, 0.41351, 299.53),
        (15000.0, 0.19476, 295.07),
    ],
)
def test_standard_atmosphere_is_the_published_one(altitude, density, sound_speed):
    """To the five digits that the tables have."""
    rho, a = standard_atmosphere(altitude)
    assert rho == pytest.approx(density, rel=5e-5)
    assert a == pytest.approx(sound_speed, rel=5e-5)
