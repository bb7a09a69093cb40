"""The law (17)/(20): G is the derivative of F, and the law gives the rates that it is asked for."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from tests.point_mass.models import F16, MODELS, drag, force_row, law, rates, trim


@pytest.mark.parametrize("name", MODELS)
@given(
    v=st.floats(200.0, 340.0),
    t=st.floats(0.0, 100e3),
    n=st.floats(-1.0, 5.0),
)
def test_first_row_of_g_is_the_derivative_of_the_force(name, v, t, n):
    """Central differences over 10 N and 1e-6; away from the knots of the identified drag table."""
    model = MODELS[name]
    step = 1e-5
    near = [force_row(model, v, 3048.0, t, n + d)[2] for d in (-10 * step, 10 * step)]
    assume(abs(near[0] - near[1]) < 1e-4 * abs(near[0]) + 1.0)  # no knot between
    _, to_thrust, to_load = force_row(model, v, 3048.0, t, n)
    high, low = (
        force_row(model, v, 3048.0, t + 10.0, n)[0],
        force_row(model, v, 3048.0, t - 10.0, n)[0],
    )
    assert to_thrust == pytest.approx((high - low) / 20.0, abs=1e-5)
    high, low = (
        force_row(model, v, 3048.0, t, n + step)[0],
        force_row(model, v, 3048.0, t, n - step)[0],
    )
    assert to_load == pytest.approx((high - low) / (2 * step), rel=1e-4, abs=1.0)


@pytest.mark.parametrize("name", MODELS)
@given(
    v=st.floats(220.0, 320.0),
    path=st.floats(-0.15, 0.15),
    k=st.tuples(st.floats(0.5, 1.0), st.floats(0.7, 1.0), st.floats(0.7, 1.0)),
    wanted=st.tuples(st.floats(-1.0, 1.0), st.floats(-0.02, 0.02), st.floats(-0.08, 0.08)),
)
def test_law_repeated_at_its_own_output_gives_the_wanted_rates(name, v, path, k, wanted):
    """u_n -> u, the limit zeta -> infinity of (10): then O of (5) is gone and the law is exact.

    30 turns of u_n = u from level trim; the effective commands then give the wanted rates to 1e-8.
    Faults of all three channels at once.
    """
    model = MODELS[name]
    u = (trim(model, v, 3048.0, path) / k[0], math.cos(path) / k[1], 0.0)
    for _ in range(30):
        u = law(model, v, 3048.0, path, u, k, wanted)
    flown = rates(model, v, 3048.0, path, k[0] * u[0], k[1] * u[1], k[2] * u[2])
    np.testing.assert_allclose(flown, wanted, atol=1e-8)


def test_law_is_finite_at_zero_load_factor():
    """G is singular at n = 0; the bank column is held away from it."""
    u = law(F16, 300.0, 3048.0, 0.0, (40e3, 0.0, 0.5), (1.0, 1.0, 1.0), (0.0, 0.01, 0.05))
    assert all(math.isfinite(value) for value in u)


def test_less_effectiveness_asks_for_more_thrust_in_proportion():
    healthy = law(F16, 300.0, 3048.0, 0.0, (40e3, 1.0, 0.0), (1.0, 1.0, 1.0), (0.0, 0.0, 0.0))
    faulty = law(F16, 300.0, 3048.0, 0.0, (40e3 / 0.6, 1.0, 0.0), (0.6, 1.0, 1.0), (0.0, 0.0, 0.0))
    assert faulty[0] == pytest.approx(healthy[0] / 0.6, rel=1e-12)
    assert drag(F16, 300.0, 3048.0, healthy[0], 1.0) > 0.0
