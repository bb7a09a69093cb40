"""The fighter's hand-written kernels are instances of the general theory: equal to 1e-12."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ftc_jsb.compiled import compiled
from ftc_jsb.control.path import acceleration, rates_of
from ftc_jsb.point_mass.dynamics import velocity
from ftc_jsb.theory.approximation import estimate_bounds
from ftc_jsb.theory.generated import generate
from ftc_jsb.theory.law import SOLVED, Reference, make_law
from ftc_jsb.theory.linearization import linearize
from ftc_jsb.theory.systems import fighter_by_position, fighter_by_velocity, textbook_plant
from tests.point_mass.models import PAPER, law, rates

VELOCITY = generate(linearize(fighter_by_velocity()))
POSITION = generate(linearize(fighter_by_position()))
LAW = make_law(VELOCITY)
PATH_LAW = make_law(POSITION)

state = st.tuples(st.floats(150.0, 400.0), st.floats(-1.0, 1.0), st.floats(-3.0, 3.0)).map(np.array)
trim = st.tuples(st.floats(0.0, 110e3), st.floats(0.3, 6.0), st.floats(-1.4, 1.4)).map(np.array)
factors = st.tuples(*[st.floats(0.2, 1.0)] * 3).map(np.array)
wanted = st.tuples(st.floats(-5, 5), st.floats(-0.1, 0.1), st.floats(-0.2, 0.2)).map(np.array)


@given(x=state, u=trim, k=factors)
def test_dynamics_are_the_flying_ones(x, u, k):
    """F of (2) from SymPy and `derivatives`: 1e-12 relative to each rate's own terms."""
    out = np.zeros(3)
    VELOCITY.dynamics(x, u, k, VELOCITY.parameters, out)
    np.testing.assert_allclose(
        out, rates(PAPER, x[0], 3048.0, x[1], *(k * u)), rtol=1e-12, atol=1e-12
    )


@given(x=state, u=trim, k=factors)
def test_drift_and_gain_of_14_are_the_flying_ones(x, u, k):
    """Script F + script G u_n is F at the trim input, and G is its derivative by the flying law.

    The flying law has no script F or G of its own: it steps from u_n. Both are compared through the
    rates that they predict for u_n plus a unit step of each input, scaled to the input's size.
    """
    drift, gain = np.zeros(3), np.zeros((3, 3))
    VELOCITY.law_terms(x, u, k, VELOCITY.parameters, drift, gain)
    at_trim = np.array(rates(PAPER, x[0], 3048.0, x[1], *(k * u)))
    scale = np.abs(drift) + np.abs(gain) @ np.abs(u) + 1.0
    np.testing.assert_allclose((drift + gain @ u) / scale, at_trim / scale, atol=1e-12)


@given(x=state, u=trim, k=factors, w=wanted)
def test_general_law_is_the_flying_law(x, u, k, w):
    """(20) by elimination of the generated G, and in closed form: 1e-12 of each command's step."""
    general = np.zeros(3)
    status = LAW(
        x, u, k, VELOCITY.parameters, Reference(x.copy(), w), np.eye(3), np.zeros(12), general
    )
    assert status == SOLVED
    flying = np.array(law(PAPER, x[0], 3048.0, x[1], u, k, w))
    scale = np.abs(u) + np.abs(general - u) + np.array([1e3, 1.0, 1.0])
    np.testing.assert_allclose(general / scale, flying / scale, atol=1e-11)


@compiled
def _rates_of(v, path, heading, a0, a1, a2):
    return rates_of(v, path, heading, (a0, a1, a2))


@given(x=state, u=trim, k=factors, w=wanted, e=st.tuples(*[st.floats(-50, 50)] * 6).map(np.array))
def test_path_loop_is_the_general_law_for_y_position(x, u, k, w, e):
    """Index (2, 2, 2) from generated code against kinematics plus the velocity law: 1e-10."""
    full = np.concatenate([x, [100.0, 200.0, 3048.0]])
    gain = np.kron(np.eye(3), [[0.25, 1.0]])
    moving = velocity(*x)
    chain = np.array([100.0, moving[0], 200.0, moving[1], 3048.0, moving[2]])
    reference = chain - e
    general = np.zeros(3)
    demanded = 10.0 * w
    status = PATH_LAW(
        full, u, k, POSITION.parameters, Reference(reference, demanded), gain, np.zeros(15), general
    )
    assert status == SOLVED
    total = demanded - gain @ e
    asked = _rates_of(x[0], x[1], x[2], *total)
    flying = np.array(law(PAPER, x[0], 3048.0, x[1], u, k, asked))
    scale = np.abs(u) + np.abs(general - u) + np.array([1e3, 1.0, 1.0])
    np.testing.assert_allclose(general / scale, flying / scale, atol=1e-10)


@given(x=state, r=wanted)
def test_rates_and_acceleration_are_each_others_inverse(x, r):
    np.testing.assert_allclose(
        _rates_of(*x, *acceleration(*x, *r)), r, atol=1e-12 * (1.0 + np.abs(r).max())
    )


def test_singular_gain_is_told_with_its_input():
    """At n = 0 the bank angle moves nothing: no pivot for input 2."""
    u = np.array([40e3, 0.0, 0.3])
    x = np.array([300.0, 0.0, 0.0])
    status = LAW(
        x, u, np.ones(3), VELOCITY.parameters, Reference(x, x), np.eye(3), np.zeros(12), np.zeros(3)
    )
    assert status == 2


def test_remainder_is_within_its_bound_over_a_box():
    """Proposition 4: ||O|| <= L_2 ||u - u_n|| on every sample, L_2 = L_1 + g_M from other samples."""
    kernels = generate(linearize(textbook_plant()))
    one = np.ones(1)

    def dynamics(x, u):
        out = np.zeros(2)
        kernels.dynamics(x, u, one, kernels.parameters, out)
        return out

    def gain(x, u):
        out = np.zeros((2, 1))
        kernels.trim_gain(x, u, one, kernels.parameters, out)
        return out

    low, high = np.array([-1.0, -1.0, -2.0]), np.array([1.0, 1.0, 2.0])
    bounds = estimate_bounds(dynamics, gain, low, high, inputs=1)
    assert bounds.remainder == pytest.approx(bounds.lipschitz + bounds.gain)
    other = estimate_bounds(dynamics, gain, low, high, inputs=1, seed=1)
    assert 0.0 < other.remainder_found <= bounds.remainder
    # by hand: |dF/du| <= 0.45 u^2 + 0.1 (1 + x2^2) + 0.1 over the box
    assert bounds.gain == pytest.approx(0.45 * 4 + 0.2 + 0.1, rel=0.02)
