"""Attitude and path: one turned into the other and back."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ftc_jsb.frames import attitude_from_path, body_rates, path_from_attitude


@given(
    path=st.floats(-1.4, 1.4),
    bank=st.floats(-math.pi, math.pi),
    alpha=st.floats(-0.5, 0.8),
)
def test_path_of_the_attitude_of_a_path_is_that_path(path, bank, alpha):
    """Without sideslip the two are inverse, to 1e-9 rad (1e-6 where pitch nears 90 deg)."""
    roll, pitch, yaw = attitude_from_path(path, bank, alpha)
    if abs(pitch) > 1.55:
        return
    back, turn, banked = path_from_attitude(alpha, 0.0, roll, pitch)
    assert back == pytest.approx(path, abs=1e-7)
    assert math.remainder(turn + yaw, 2.0 * math.pi) == pytest.approx(0.0, abs=1e-6)
    assert math.remainder(banked - bank, 2.0 * math.pi) == pytest.approx(0.0, abs=1e-6)


def test_attitude_against_rotation_matrices():
    """Body axes as matrices multiplied in order, heading, path, bank, alpha: to 1e-12."""

    def about(axis: int, angle: float) -> np.ndarray:
        c, s = math.cos(angle), math.sin(angle)
        a, b = [(1, 2), (2, 0), (0, 1)][axis]
        m = np.eye(3)
        m[a, a] = m[b, b] = c
        m[a, b], m[b, a] = -s, s
        return m

    for path, bank, alpha in ((0.1, 1.2, 0.05), (-0.3, -2.0, 0.2), (0.0, 0.0, 0.1)):
        wind = about(1, path) @ about(0, bank)  # north-east-down to wind axes
        body = wind @ about(1, alpha)
        roll, pitch, yaw = attitude_from_path(path, bank, alpha)
        euler = about(2, yaw) @ about(1, pitch) @ about(0, roll)
        np.testing.assert_allclose(euler, body, atol=1e-12)


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
