"""Indices are found, not given; the chain (15) is right; what has no index or does not fit is refused."""

import numpy as np
import pytest
import sympy as sp

from ftc_jsb.errors import TheoryError
from ftc_jsb.theory.linearization import linearize
from ftc_jsb.theory.system import System
from ftc_jsb.theory.systems import fighter_by_position, fighter_by_velocity, textbook_plant

X1, X2, X3, U, W = sp.symbols("x1 x2 x3 u w", real=True)


def system(dynamics, outputs, inputs=(U,), states=(X1, X2, X3)):
    return System("test", states, inputs, {}, dynamics, outputs)


@pytest.mark.parametrize(
    ("shipped", "index"),
    [(fighter_by_velocity, (1, 1, 1)), (fighter_by_position, (2, 2, 2)), (textbook_plant, (2,))],
)
def test_indices_of_the_shipped_systems(shipped, index):
    assert linearize(shipped()).index == index


def test_chain_of_integrators_has_the_index_of_its_length():
    linear = linearize(system((X2, X3, sp.sinh(U)), (X1,)))
    assert linear.index == (3,)
    assert list(linear.chain) == [X1, X2, X3]


def test_input_that_cancels_does_not_count():
    """y1' = (1 + u)^2 - u^2 - 2 u = 1: no input there, though it is written with one."""
    hidden = (1 + U) ** 2 - U**2 - 2 * U + X2
    assert linearize(system((hidden, X3, U), (X1,))).index == (3,)


def test_output_that_no_input_reaches_is_named():
    with pytest.raises(TheoryError, match=r"output 0 \(x1\) has no linearizability index"):
        linearize(system((-X1, U, -X3), (X1,)))


def test_more_outputs_than_inputs_are_refused():
    with pytest.raises(TheoryError, match=r"2 outputs \(n\) and 1 inputs \(m\)"):
        system((X2, X3, U), (X1, X2))


def test_unknown_symbols_are_named():
    with pytest.raises(TheoryError, match="rate 0: unknown w"):
        system((W, X3, U), (X1,))
    with pytest.raises(TheoryError, match="output 0: u is no state"):
        system((X2, X3, U), (U,))


def test_matrices_of_14_are_chains_of_integrators():
    a, b, c = linearize(fighter_by_position()).brunovsky()
    np.testing.assert_array_equal(a[0:2, 0:2], [[0, 1], [0, 0]])
    np.testing.assert_array_equal(a @ a, 0.0)
    np.testing.assert_array_equal(b.T @ b, np.eye(3))
    np.testing.assert_array_equal(c @ c.T, np.eye(3))
    np.testing.assert_array_equal(c @ a @ b, np.eye(3))


def test_affine_form_is_the_expansion_at_the_trim_input():
    """(4)-(7) in symbols: f + g u + O is F, and O vanishes with its derivative at u = u_n."""
    linear = linearize(textbook_plant())
    approximation = linear.approximation
    u = linear.system.inputs
    whole = approximation.f + approximation.g * sp.Matrix(u) + approximation.remainder
    assert sp.simplify(whole - linear.system.faulty_dynamics) == sp.zeros(2, 1)
    at_trim = dict(zip(u, approximation.trim, strict=True))
    assert approximation.remainder.subs(at_trim).applyfunc(sp.simplify) == sp.zeros(2, 1)
    slope = approximation.remainder.jacobian(list(u)).subs(at_trim)
    assert slope.applyfunc(sp.simplify) == sp.zeros(2, 1)


@pytest.mark.parametrize(
    "hidden",
    [(U + U**3 / 10) / 5_000_000_000, (U + 0.1 * U**3) / 5e9, 5e-10 * U, sp.sin(U) * 1e-40],
)
def test_index_does_not_depend_on_units(hidden):
    """A path of any size is a path: x2' in units of 5e9 has the index that it has in any other."""
    assert linearize(system((X2, X3 + hidden, U), (X1,))).index == (2,)


@pytest.mark.parametrize(
    "nothing",
    [
        sp.sin(U) ** 2 + sp.cos(U) ** 2,
        0.1 * U * (1 + X1) - 0.1 * U - 0.1 * U * X1,
        (sp.exp(U) - sp.exp(-U)) / 2 - sp.sinh(U),
        1e12 * ((1 + U) ** 2 - U**2 - 2 * U),
    ],
)
def test_path_that_cancels_is_none(nothing):
    """Identities of trigonometry, decimals and large factors: no input in x2', so index 3."""
    assert linearize(system((X2, X3 + nothing, U), (X1,))).index == (3,)


def test_gain_that_is_singular_everywhere_is_refused():
    """Both outputs move by u + w only: G = [1, 1; 1, 1]."""
    both = U + W + U**3 / 3 + W * U**2
    with pytest.raises(TheoryError, match=r"G of .14. has rank 1 everywhere, for 2 outputs"):
        linearize(system((both, 2 * both + X1, -X3), (X1, X2), inputs=(U, W)))


def test_more_inputs_than_outputs_are_linearized_for_an_allocation():
    linear = linearize(system((X2, X3 + U + W**3, -X3), (X1,), inputs=(U, W)))
    assert linear.index == (2,)
    assert linear.gain.shape == (1, 2)
