"""Fit of the side-force coefficient from sideslip, rudder, aileron, roll and yaw rate."""

from typing import NamedTuple

import numpy as np

from ftc_jsb.identify.angles_drag import SMOOTH, AnglesDrag
from ftc_jsb.identify.regression import RIDGE, Array, hats, second_differences, solve
from ftc_jsb.identify.samples import Samples, between_knots


class SideForce(NamedTuple):
    """Side-force coefficient: the terms of `side_force.side_force_coefficient`, at the drag's knots."""

    mach: Array
    alpha: Array
    sideslip_mach: Array
    sideslip_alpha: Array
    sideslip_squared: float
    roll_rate: Array
    yaw_rate: Array
    aileron: float
    rudder: float

    def predict(self, data: Samples) -> Array:
        """C_Y of samples."""
        rows = (self.sideslip_mach, self.sideslip_alpha, self.roll_rate, self.yaw_rate)
        scalars = (self.sideslip_squared, self.aileron, self.rudder)
        return np.asarray(_design(data, self.mach, self.alpha) @ np.concatenate([*rows, scalars]))

    def slope(self, data: Samples) -> Array:
        """dC_Y/d(sideslip) of samples [1/rad]."""
        linear = hats(data.mach, self.mach) @ self.sideslip_mach
        linear += hats(data.alpha, self.alpha) @ self.sideslip_alpha
        return np.asarray(linear + 2.0 * self.sideslip_squared * np.abs(data.sideslip))


def _design(data: Samples, mach: Array, alpha: Array) -> Array:
    at_alpha = hats(data.alpha, alpha)
    return np.hstack(
        [
            hats(data.mach, mach) * data.sideslip[:, None],
            at_alpha * data.sideslip[:, None],
            at_alpha * data.roll_rate[:, None],
            at_alpha * data.yaw_rate[:, None],
            (data.sideslip * np.abs(data.sideslip))[:, None],
            data.aileron[:, None],
            data.rudder[:, None],
        ]
    )


def fit_side_force(data: Samples, drag: AnglesDrag) -> SideForce:
    """C_Y, least squares of the residual.

    Args:
        data: samples, those in gusts among them: only gusts make sideslip that a loop does not cancel.
        drag: whose knots are taken.
    """
    mach, alpha = drag.mach, drag.alpha
    data = between_knots(data, mach)
    m, n = len(mach), len(alpha)
    sizes = np.cumsum([m, n, n, n, 1, 1, 1])
    smooth = np.zeros((m + n - 4, sizes[-1]))
    smooth[: m - 2, :m] = second_differences(m, 1)
    smooth[m - 2 :, m : m + n] = second_differences(n, 1)
    solution = solve(
        _design(data, mach, alpha),
        data.side,
        np.full(len(data.side), 1.0 / np.sqrt(np.mean(data.side**2))),
        [SMOOTH * smooth, RIDGE * np.eye(sizes[-1])],
    )
    parts = np.split(solution, sizes[:-1])
    by_mach, by_alpha, roll_rate, yaw_rate, squared, aileron, rudder = parts
    return SideForce(
        mach, alpha, by_mach, by_alpha, float(squared[0]), roll_rate, yaw_rate, float(aileron[0]),
        float(rudder[0]),
    )  # fmt: skip
