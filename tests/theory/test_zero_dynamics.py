"""What the outputs do not show is analysed: none, stable, unstable, undecided."""

import numpy as np
import pytest
import sympy as sp

from ftc_jsb.theory.closed_loop import TheoryWarning, warn_of_zero_dynamics
from ftc_jsb.theory.linearization import linearize
from ftc_jsb.theory.system import System
from ftc_jsb.theory.systems import fighter_by_velocity
from ftc_jsb.theory.zero_dynamics import zero_dynamics

X1, X2, X3, U, W = sp.symbols("x1 x2 x3 u w", real=True)


def beside(rate, states=(X1, X2)):
    """Output x1 is driven by u, and x2 by x1 and itself."""
    return System("beside", states, (U,), {}, (sp.sinh(U), rate), (X1,))


@pytest.mark.parametrize(
    ("rate", "verdict", "zero"),
    [
        (X1 - 3 * X2, "stable", -3.0),
        (X1 + 2 * sp.sin(X2), "unstable", 2.0),
        (X2**3, "undecided", 0),
    ],
)
def test_zeros_are_those_of_the_hidden_state(rate, verdict, zero):
    found = zero_dynamics(linearize(beside(rate)), [0.0, 0.0], [0.0])
    assert found.dimension == 1
    assert found.verdict == verdict
    assert found.zeros[0] == pytest.approx(zero, abs=1e-6)


def test_system_of_full_index_has_none():
    assert zero_dynamics(linearize(fighter_by_velocity()), [300, 0, 0], [4e4, 1, 0]).dimension == 0


def test_allocation_moves_the_inputs_as_the_law_does():
    """Two inputs, one output: u and w share the work evenly, so x2' = w - x2 is driven by y'/2."""
    system = System("shared", (X1, X2), (U, W), {}, (U + W, W - X2), (X1,))
    found = zero_dynamics(linearize(system), [0.0, 0.0], [0.0, 0.0])
    np.testing.assert_allclose(found.zeros, [-1.0], atol=1e-9)


def test_unstable_zero_dynamics_do_not_fly_unwarned():
    """The first thing that `ClosedLoop.fly` does."""
    linear = linearize(beside(X1 + 2 * X2))
    with pytest.warns(TheoryWarning, match=r"unstable at the start: a zero at 2"):
        warn_of_zero_dynamics(linear, np.zeros(2), np.zeros(1))
