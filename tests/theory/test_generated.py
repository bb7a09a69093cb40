"""The fighter's hand-written kernels are instances of the general theory: equal to 1e-12."""

import numpy as np
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from ftc_jsb.compiled import compiled
from ftc_jsb.control.path import acceleration, rates_of
from ftc_jsb.point_mass.dynamics import velocity
from ftc_jsb.theory.generated import generate
from ftc_jsb.theory.kernels.law import SOLVED, Reference, Tuning
from ftc_jsb.theory.linearization import linearize
from ftc_jsb.theory.system import System
from ftc_jsb.theory.systems import fighter_by_position, fighter_by_velocity
from tests.point_mass.models import PAPER, law, rates

VELOCITY = generate(linearize(fighter_by_velocity()))
POSITION = generate(linearize(fighter_by_position()))
SIZES = np.array([1e5, 5.0, 1.0])  # N, 1, rad


def general_law(kernels, x, u_n, k, reference, gain):
    """The command, and the status."""
    u, tuning = np.zeros(3), Tuning(gain, SIZES, u_n)
    scratch = np.zeros(kernels.scratch)
    status = kernels.law(x, u_n, k, kernels.parameters, reference, tuning, scratch, u)
    return u, status


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
    general, status = general_law(VELOCITY, x, u, k, Reference(x.copy(), w), np.eye(3))
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
    demanded = 10.0 * w
    general, status = general_law(POSITION, full, u, k, Reference(reference, demanded), gain)
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
    _, status = general_law(VELOCITY, x, u, np.ones(3), Reference(x, x), np.eye(3))
    assert status == 2


def test_step_that_no_input_can_make_is_singular():
    """1e-30 u for a rate of 1: the step would be 1e30, and one pivot says nothing about its own size."""
    x, u = sp.symbols("x u", real=True)
    weak = generate(linearize(System("weak", (x,), (u,), {}, (sp.Rational(1, 10**30) * u,), (x,))))
    one, command = np.ones(1), np.zeros(1)
    arguments = (np.zeros(1), np.zeros(1), one, weak.parameters, Reference(one, one))
    tuning = Tuning(np.ones((1, 1)), one, np.zeros(1))
    assert weak.law(*arguments, tuning, np.zeros(weak.scratch), command) == 0
    assert abs(command[0]) > 1e29


def test_allocation_takes_the_least_step_that_does_it():
    """X' = u + 3 w: u + 3 w is what is demanded, shared as 1 to 3, and away from the preferred inputs."""
    x, u, w = sp.symbols("x u w", real=True)
    shared = generate(linearize(System("shared", (x,), (u, w), {}, (u + 3 * w,), (x,))))
    preferred, command, one = np.array([1.0, 0.0]), np.zeros(2), np.ones(1)
    arguments = (np.zeros(1), np.zeros(2), np.ones(2), shared.parameters, Reference(one, one))
    tuning = Tuning(np.ones((1, 1)), np.ones(2), preferred)
    assert shared.law(*arguments, tuning, np.zeros(shared.scratch), command) == SOLVED
    np.testing.assert_allclose(command, [1.1, 0.3])  # demanded: 2
