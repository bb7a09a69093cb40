"""Attitude and path: one turned into the other and back."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ftc_jsb.frames import attitude_from_path, path_from_attitude


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
