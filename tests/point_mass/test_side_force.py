"""Side force and the sideslip that it tells are each other's inverse, on every shipped fighter."""

import numpy as np
import pytest

from ftc_jsb.aircraft.point_mass_file import load_point_mass
from ftc_jsb.point_mass.side_force import (
    SideRates,
    side_force_coefficient,
    sideslip_of_side_force,
)
from ftc_jsb.resources import aircraft_folder

OTHERS = SideRates(roll_rate=0.002, yaw_rate=0.0003, aileron=0.05, rudder=-0.03)


@pytest.mark.parametrize("name", ["f16", "f15", "F4N", "A4", "T38"])
def test_sideslip_is_found_from_its_side_force(name):
    """Both signs and none, low and high Mach, alpha: to 1e-9 rad, and the slope is the difference quotient."""
    model = load_point_mass(aircraft_folder(name)).record(0.4)[0]
    assert model["side_force_count"] > 0
    for mach in (0.55, 0.9):
        for alpha in np.radians((1.0, 7.0)):
            for sideslip in np.radians((-2.0, -0.3, 0.0, 0.05, 1.5)):
                given = (model, mach, alpha)
                side = side_force_coefficient(*given, sideslip, OTHERS)
                told = sideslip_of_side_force(*given, side, OTHERS)
                assert told.angle == pytest.approx(sideslip, abs=1e-9)
                more = side_force_coefficient(*given, sideslip + 1e-7, OTHERS)
                assert told.slope == pytest.approx((more - side) / 1e-7, rel=1e-3)
