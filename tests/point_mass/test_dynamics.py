"""(41)-(43) against the formulas as printed, and what symmetry and equilibrium demand."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ftc_jsb.point_mass.dynamics import velocity
from tests.point_mass.models import F16, MODELS, PAPER, drag, polar, rates, trim

SPEED = st.floats(120.0, 400.0)
PATH = st.floats(-1.2, 1.2)
THRUST = st.floats(0.0, 120e3)
LOAD = st.floats(-3.0, 7.0)
BANK = st.floats(-3.0, 3.0)


@given(v=SPEED, path=PATH, t=THRUST, n=LOAD, bank=BANK)
def test_paper_aircraft_obeys_41_and_43_as_printed(v, path, t, n, bank):
    """Table 1 put into (41) and (43) by hand; 1e-12 relative, which is rounding."""
    g, rho, s = 9.81, 1.2251, 37.16
    w = 14515.0 * g
    d = 0.5 * rho * v**2 * s * 0.02 + 2.0 * 0.1 * n**2 * w**2 / (rho * v**2 * s)
    expected = (
        g * ((t - d) / w - math.sin(path)),
        g / v * (n * math.cos(bank) - math.cos(path)),
        g * n * math.sin(bank) / (v * math.cos(path)),
    )
    assert drag(PAPER, v, 3048.0, t, n) == pytest.approx(d, rel=1e-12)
    np.testing.assert_allclose(
        rates(PAPER, v, 3048.0, path, t, n, bank), expected, rtol=1e-12, atol=1e-13
    )


@pytest.mark.parametrize("name", MODELS)
@given(v=SPEED, path=PATH, t=THRUST, n=LOAD, bank=BANK)
def test_left_and_right_are_mirror_images(name, v, path, t, n, bank):
    right, left = (
        rates(MODELS[name], v, 3048.0, path, t, n, bank),
        rates(MODELS[name], v, 3048.0, path, t, n, -bank),
    )
    assert left == (right[0], right[1], -right[2])


@pytest.mark.parametrize("name", MODELS)
@given(v=st.floats(200.0, 340.0), path=st.floats(-0.2, 0.2))
def test_level_trim_holds_speed_and_path(name, v, path):
    """At the trim thrust, n = cos(path), wings level: no rate is above 1e-9 of g."""
    thrust = trim(MODELS[name], v, 3048.0, path)
    np.testing.assert_allclose(
        rates(MODELS[name], v, 3048.0, path, thrust, math.cos(path), 0.0), 0.0, atol=1e-8
    )


def test_more_thrust_accelerates_more_load_factor_brakes_and_climbs_right_bank_turns_right():
    """The signs that every other test takes for granted."""
    level = rates(F16, 300.0, 3048.0, 0.0, 40e3, 1.0, 0.0)
    assert rates(F16, 300.0, 3048.0, 0.0, 50e3, 1.0, 0.0)[0] > level[0]
    assert rates(F16, 300.0, 3048.0, 0.0, 40e3, 3.0, 0.0)[0] < level[0]
    assert rates(F16, 300.0, 3048.0, 0.0, 40e3, 3.0, 0.0)[1] > 0.0
    assert rates(F16, 300.0, 3048.0, 0.0, 40e3, 2.0, 1.0)[2] > 0.0


@given(v=SPEED, path=PATH, heading=st.floats(-10.0, 10.0))
def test_velocity_has_the_airspeed_as_its_length_and_points_up_in_a_climb(v, path, heading):
    north, east, up = velocity(v, path, heading)
    assert math.hypot(north, east, up) == pytest.approx(v, rel=1e-12)
    assert up == pytest.approx(v * math.sin(path))
    assert math.atan2(east, north) == pytest.approx(math.remainder(heading, 2 * math.pi), abs=1e-9)


@given(v=st.floats(170.0, 340.0), lift=st.floats(-0.15, 1.0))
def test_slope_of_the_identified_polar_is_its_derivative(v, lift):
    """Central difference over 1e-6; knots of the table, where the slope jumps, are stepped around."""
    knot = (lift + 0.2) / 0.05
    if abs(knot - round(knot)) < 1e-3:
        lift += 1e-3
    high, low = polar(F16, v, 3048.0, lift + 1e-6)[0], polar(F16, v, 3048.0, lift - 1e-6)[0]
    assert polar(F16, v, 3048.0, lift)[1] == pytest.approx((high - low) / 2e-6, abs=1e-7)
