"""Constants of Assumption 2 and Proposition 4: enclosed, against what can be had by hand."""

import numpy as np
import pytest
import sympy as sp

from ftc_jsb.theory.bounds import bounds, unbounded
from ftc_jsb.theory.enclosure import largest
from ftc_jsb.theory.generated import generate
from ftc_jsb.theory.linearization import linearize
from ftc_jsb.theory.system import System
from ftc_jsb.theory.systems import fighter_by_velocity, textbook_plant

X, U = sp.symbols("x u", real=True)


def test_constants_of_the_textbook_plant_are_those_found_by_hand():
    """|dF/du| is largest in a corner: 0.45 4 + 0.1 2 + 0.1 cos 0.2 = 2.0980 for k = 1, x in [-1, 1],
    u in [-2, 2]; L_2 is twice that, and M is 0.9 2 + 0.01 sin 0.2 = 1.8020 (sine's sign turned: less).
    """
    found = bounds(textbook_plant())
    slope = 1.8 + 0.2 + 0.1 * np.cos(0.2)
    for enclosure, exact in (
        (found.gain, slope),
        (found.lipschitz, slope),
        (found.remainder, 2.0 * slope),
        (found.curvature, 1.8 - 0.01 * np.sin(0.2)),
    ):
        assert enclosure.certified
        assert enclosure.least <= exact * (1.0 + 1e-9)
        assert exact <= enclosure.most <= 1.01 * exact
    assert "to" in str(found.gain)


def test_remainder_stays_below_both_its_bounds():
    """||O|| <= L_2 ||u - u_n|| and <= M/2 ||u - u_n||^2 at 4000 random points of the box."""
    system = textbook_plant()
    found, kernels = bounds(system), generate(linearize(system))
    random, nearest = np.random.default_rng(0), 0.0
    for _ in range(4000):
        x, u, trim = random.uniform(-1, 1, 2), random.uniform(-2, 2, 1), random.uniform(-2, 2, 1)
        k = random.uniform(0.3, 1.0, 1)
        exact, at, g = np.zeros(2), np.zeros(2), np.zeros((2, 1))
        kernels.dynamics(x, u, k, kernels.parameters, exact)
        kernels.dynamics(x, trim, k, kernels.parameters, at)
        kernels.trim_gain(x, trim, k, kernels.parameters, g)
        size = np.linalg.norm(exact - at - g @ (u - trim))
        step = np.linalg.norm(u - trim)
        assert size <= found.remainder.most * step
        assert size <= found.curvature.most / 2.0 * step**2 * (1.0 + 1e-9) + 1e-14
        nearest = max(nearest, size / (found.curvature.most / 2.0 * step**2))
    assert nearest > 0.8


def test_assumption_2_fails_for_inputs_without_limit_on_both_shipped_systems():
    assert unbounded(textbook_plant()) == ("d(x2')/du grows without limit with u",)
    assert "d(V')/dn grows without limit with n" in unbounded(fighter_by_velocity())
    tame = System("tame", (X,), (U,), {}, (sp.tanh(U) + sp.sin(U),), (X,))
    assert unbounded(tame) == ()


def test_function_without_interval_arithmetic_says_at_least():
    """Bessel's J_0 is not among the enclosed functions: 1 is met at 0, and nothing is proven."""
    found = largest(sp.Matrix([[sp.besselj(0, X)]]), {X: (-3.0, 3.0)})
    assert not found.certified
    assert found.least == pytest.approx(1.0, abs=1e-4)
    assert str(found).startswith("at least 1")


@pytest.mark.parametrize(
    ("expression", "exact"),
    [
        (X**2 - X, 6.0),
        (sp.exp(-(X**2)), 1.0),
        (sp.sqrt(1 + X**2) * sp.cos(X), np.sqrt(5.0) * abs(np.cos(2.0))),
        (sp.Abs(X) ** 3 / (3 + sp.sin(X)), 8.0 / (3.0 - np.sin(2.0))),
    ],
)
def test_enclosures_hold_the_supremum(expression, exact):
    """Over [-2, 2], corners and inner points: within one per cent, on the right side of it."""
    exact = max(exact, 1.0) if expression.has(sp.cos) else exact
    found = largest(sp.Matrix([[expression]]), {X: (-2.0, 2.0)})
    assert found.least <= exact * (1.0 + 1e-12)
    assert exact * (1.0 - 1e-12) <= found.most <= 1.011 * exact
