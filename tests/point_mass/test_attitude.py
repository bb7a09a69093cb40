"""Attitude of coordinated flight against rotation matrices and against JSBSim."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from ftc_jsb.point_mass.attitude import attitude, body_rates

ANGLE = st.floats(-1.4, 1.4)


def matrix(yaw, pitch, roll):
    """Body to level frame."""
    return Rotation.from_euler("ZYX", [yaw, pitch, roll]).as_matrix()


@given(
    path=ANGLE,
    heading=st.floats(-10.0, 10.0),
    bank=st.floats(-3.1, 3.1),
    alpha=st.floats(-0.4, 0.4),
)
def test_attitude_is_the_wind_axes_pitched_by_alpha(path, heading, bank, alpha):
    roll, pitch, yaw = attitude(path, heading, bank, alpha)
    expected = matrix(heading, path, bank) @ matrix(0.0, alpha, 0.0)
    np.testing.assert_allclose(matrix(yaw, pitch, roll), expected, atol=1e-9)
    assert abs(yaw - heading) <= math.pi


def test_level_flight_pitches_by_alpha_and_a_climb_adds_the_path():
    assert attitude(0.0, 0.3, 0.0, 0.05) == pytest.approx((0.0, 0.05, 0.3))
    assert attitude(0.1, 0.3, 0.0, 0.05) == pytest.approx((0.0, 0.15, 0.3))


def test_attitude_is_that_of_the_jsbsim_aircraft(flown):
    """The paper's manoeuvre on the F-16, whose sideslip is below 1.5 deg: within 2 deg, 0.3 RMS."""
    record = flown("paper", "model=jsbsim").record
    errors = []
    for row in record[::50]:
        found = attitude(row["flight_path_angle"], row["heading"], row["bank_angle"], row["alpha"])
        errors.append(np.subtract(found, [row["roll"], row["pitch"], row["yaw"]]))
    errors = np.degrees(errors)
    assert np.abs(errors).max() < 2.0
    assert np.sqrt(np.mean(errors**2, axis=0)).max() < 0.3


def test_rates_are_those_of_the_jsbsim_aircraft(flown):
    """Differences of its recorded Euler angles over 10 ms: within 0.5 deg/s of its own, RMS."""
    record = flown("paper", "model=jsbsim").record
    errors = []
    for before, after in zip(record[:-1:50], record[1::50], strict=True):
        angles = [(row["roll"], row["pitch"], row["yaw"]) for row in (before, after)]
        mean = [(before[f"{n}_rate"] + after[f"{n}_rate"]) / 2 for n in ("roll", "pitch", "yaw")]
        errors.append(np.subtract(body_rates(*angles, 0.01), mean))
    assert np.degrees(np.sqrt(np.mean(np.square(errors), axis=0))).max() < 0.5


def test_rates_of_a_roll_through_inverted_flight():
    """From 179 to -179 deg of roll in 10 ms: 200 deg/s, not the long way round."""
    a, b = math.radians(179.0), math.radians(-179.0)
    assert body_rates((a, 0.0, 0.0), (b, 0.0, 0.0), 0.01)[0] == pytest.approx(math.radians(200.0))
