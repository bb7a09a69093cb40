"""The measurement update against the Kalman filter in matrices; gate, patience, bounds, silent instruments."""

import numpy as np
import pytest

from ftc_jsb.estimation.process import FILTER
from ftc_jsb.estimation.update import update, update_by_state

N = 4
R = np.array([0.5, 0.1, 0.2])
X = np.array([1.0, 2.0, -1.0, 0.7])
H = np.eye(3, N)


def covariance():
    root = np.random.default_rng(3).normal(size=(N, N))
    return root @ root.T + np.eye(N)


def filters():
    made = np.zeros(1, FILTER)
    made[0]["count"] = N
    made[0]["estimate"][:N] = X
    made[0]["covariance"][:N, :N] = covariance()
    return made


def state(made):
    return made[0]["estimate"][:N], made[0]["covariance"][:N, :N]


def corrected(h, r, innovation):
    """Estimate and covariance of the textbook, P - K S K^T."""
    p = covariance()
    s = h @ p @ h.T + r
    gain = p @ h.T @ np.linalg.inv(s)
    return X + gain @ innovation, p - gain @ s @ gain.T


def test_three_outputs_are_the_textbooks():
    y, made = np.array([1.4, 1.5, -0.3]), filters()
    update(made[0], y, R, 0.0, 0, 0.0)
    innovation = y - X[:3]
    x, p = corrected(H, np.diag(R), innovation)
    np.testing.assert_allclose(state(made)[0], x, rtol=1e-12)
    np.testing.assert_allclose(state(made)[1], p, rtol=1e-10, atol=1e-12)
    spread = covariance()[:3, :3] + np.diag(R)
    assert made[0]["nis"] == pytest.approx(innovation @ np.linalg.solve(spread, innovation))
    np.testing.assert_allclose(made[0]["innovation"], innovation)


def test_one_output_is_the_textbooks():
    made = filters()
    deviation = update_by_state(made[0], 3, 2.5, 0.8, 0.3, 0.0)
    h = np.array([[0.0, 0.0, 0.0, 2.5]])
    x, p = corrected(h, np.array([[0.3]]), np.array([0.8]))
    np.testing.assert_allclose(state(made)[0], x, rtol=1e-12)
    np.testing.assert_allclose(state(made)[1], p, rtol=1e-10, atol=1e-12)
    assert deviation == pytest.approx(np.sqrt(2.5**2 * covariance()[3, 3] + 0.3))


def test_silent_instrument_costs_itself_alone():
    made, alone = filters(), filters()
    update(made[0], np.array([1.4, np.nan, -0.3]), R, 0.0, 0, 0.0)
    update_by_state(alone[0], 0, 1.0, 1.4 - alone[0]["estimate"][0], R[0], 0.0)
    update_by_state(alone[0], 2, 1.0, -0.3 - alone[0]["estimate"][2], R[2], 0.0)
    np.testing.assert_array_equal(state(made)[0], state(alone)[0])
    np.testing.assert_array_equal(state(made)[1], state(alone)[1])


def test_gate_refuses_as_often_as_its_patience_and_then_follows():
    far, made = np.array([50.0, 2.0, -1.0]), filters()
    for refused in (1, 2):
        update(made[0], far, R, 9.0, 2, 0.0)
        assert made[0]["rejected"] == refused
        np.testing.assert_array_equal(state(made)[0], X)
    update(made[0], far, R, 9.0, 2, 0.0)
    assert made[0]["rejected"] == 0
    assert state(made)[0][0] > 10.0
    ungated = filters()
    update(ungated[0], far, R, 0.0, 2, 0.0)
    np.testing.assert_array_equal(state(made)[0], state(ungated)[0])


@pytest.mark.parametrize(("innovation", "bound"), [(50.0, 1.0), (-50.0, 0.05)])
def test_effectiveness_is_kept_in_its_bounds_and_the_outputs_are_not(innovation, bound):
    made, free = filters(), filters()
    update_by_state(made[0], 3, 1.0, innovation, 0.1, 0.05)
    update_by_state(free[0], 3, 1.0, innovation, 0.1, 0.0)
    assert state(made)[0][3] == bound
    assert abs(state(free)[0][3]) > 5.0
    np.testing.assert_array_equal(state(made)[0][:3], state(free)[0][:3])
