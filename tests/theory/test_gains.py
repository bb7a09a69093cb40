"""Gains three ways, H of (19), and what is refused."""

import numpy as np
import pytest

from ftc_jsb.errors import TheoryError
from ftc_jsb.theory.gains import decaying_gains, given_gains, lqr_gains, placed_gains

A = np.array([[0.0, 1.0], [0.0, 0.0]])
B = np.array([[0.0], [1.0]])


def test_placed_poles_are_where_they_are_wanted_and_h_solves_19():
    gains = placed_gains(A, B, np.array([-2.0, -3.0]))
    np.testing.assert_allclose(gains.k, [[6.0, 5.0]])
    closed = A - B @ gains.k
    np.testing.assert_allclose(closed.T @ gains.h + gains.h @ closed, -gains.q, atol=1e-12)
    assert np.linalg.eigvalsh(gains.h).min() > 0.0


def test_lqr_of_a_double_integrator_is_known():
    """Unit weights: K = [1, sqrt(3)] (any textbook)."""
    np.testing.assert_allclose(
        lqr_gains(A, B, np.eye(2), np.eye(1)).k, [[1.0, np.sqrt(3.0)]], rtol=1e-9
    )


def test_gain_of_the_paper_has_h_of_one_half():
    """A = 0, B = I, K = I: (19) gives H = Q / 2."""
    gains = given_gains(np.zeros((3, 3)), np.eye(3), np.eye(3))
    np.testing.assert_allclose(gains.h, 0.5 * np.eye(3))


@pytest.mark.parametrize(
    ("k", "q", "says"),
    [
        ([[-1.0, 1.0]], None, "not Hurwitz: an eigenvalue has real part"),
        ([[1.0, 1.0]], [[1.0, 0.0], [0.0, -1.0]], "Q of .19. is not positive definite"),
        ([[1.0, 1.0]], [[1.0, 1.0], [0.0, 1.0]], "not symmetric"),
        ([[1.0]], None, r"K has shape \(1, 1\); expected \(1, 2\)"),
    ],
)
def test_unusable_gain_is_refused_with_its_reason(k, q, says):
    with pytest.raises(TheoryError, match=says):
        given_gains(A, B, np.array(k), None if q is None else np.array(q))


def test_decaying_gains_solve_19_and_decay_as_told():
    """Poles -20 and -30: the least eigenvalue of H^-1 Q is at least 2 x 16."""
    gains = decaying_gains(A, B, np.array([[600.0, 50.0]]), 16.0)
    closed = A - B @ gains.k
    np.testing.assert_allclose(
        closed.T @ gains.h + gains.h @ closed, -gains.q, atol=1e-9 * np.abs(gains.q).max()
    )
    assert np.linalg.eigvals(np.linalg.solve(gains.h, gains.q)).real.min() >= 32.0


def test_poles_that_cannot_be_placed_are_refused():
    with pytest.raises(TheoryError, match="cannot be placed"):
        placed_gains(A, B, np.array([-1.0, -1.0]))
