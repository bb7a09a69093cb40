"""Fit of the drag polar and of the angle of attack over Mach and lift coefficient."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ftc_jsb.identify.knots import MACH_STEP, at_most, mach_knots, regular_knots
from ftc_jsb.identify.regression import RIDGE, Array, hats, products, second_differences, solve
from ftc_jsb.identify.samples import Samples, between_knots
from ftc_jsb.point_mass.model import LIFT_KNOTS, MACH_KNOTS

LIFT_STEP = 0.025
SMOOTH = 1e-3  # of the polar across Mach knots: what no flight has seen is like its neighbours


def _parabolas(values: Array, terms: int) -> Array:
    return np.stack([values**power for power in range(terms)], axis=1)


class Polar(NamedTuple):
    """Drag polar: a parabola for each Mach knot, and a table on top."""

    mach: Array
    lift: Array
    parabola: Array  # (mach, 3)
    table: Array  # (mach, lift)

    def predict(self, data: Samples) -> Array:
        """C_D of samples."""
        return np.asarray(
            _polar_design(data, self.mach, self.lift)
            @ np.concatenate([self.parabola.ravel(), self.table.ravel()])
        )


def _polar_design(data: Samples, mach: Array, lift: Array) -> Array:
    at_mach = hats(data.mach, mach)
    return np.hstack(
        [
            products(at_mach, _parabolas(data.lift, 3)),
            products(at_mach, hats(data.lift, lift)),
        ]
    )


def fit_polar(data: Samples, breaks: Sequence[float]) -> Polar:
    """C_D(C_L, Mach), least squares of the relative residual.

    Args:
        data: samples whose drag is that without sideslip.
        breaks: Mach numbers at which flaps switch.
    """
    mach = at_most(MACH_KNOTS, lambda step: mach_knots(data.mach, breaks, step), MACH_STEP)
    lift = at_most(LIFT_KNOTS, lambda step: regular_knots(data.lift, step), LIFT_STEP)
    data = between_knots(data, mach, lift)
    m, n = len(mach), len(lift)
    level = 1.0 / np.mean(data.drag)
    parabola_part = np.hstack([second_differences(m, 3), np.zeros((max(m - 2, 0) * 3, m * n))])
    table_part = np.hstack([np.zeros((m * n, m * 3)), np.eye(m * n)])
    solution = solve(
        _polar_design(data, mach, lift),
        data.drag,
        1.0 / data.drag,
        [SMOOTH * level * parabola_part, 10.0 * RIDGE * level * table_part],
    )
    return Polar(mach, lift, solution[: 3 * m].reshape(m, 3), solution[3 * m :].reshape(m, n))


def fit_alpha(data: Samples, mach: Array) -> Array:
    """Angle of attack [rad] over (Mach, powers 0..3 of C_L): (mach, 4)."""
    data = between_knots(data, mach)
    design = products(hats(data.mach, mach), _parabolas(data.lift, 4))
    weight = np.full(len(data.alpha), 1.0 / np.radians(1.0))
    penalty = 100.0 * SMOOTH / np.radians(1.0) * 1e-2 * second_differences(len(mach), 4)
    return solve(design, data.alpha, weight, [penalty]).reshape(len(mach), 4)
