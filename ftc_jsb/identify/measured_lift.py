"""Fit of the lift coefficient from measured angle of attack, elevator, flap, pitch and path rate."""

from typing import NamedTuple

import numpy as np

from ftc_jsb.identify.angles_drag import SMOOTH, AnglesDrag
from ftc_jsb.identify.regression import RIDGE, Array, hats, products, second_differences, solve
from ftc_jsb.identify.samples import Samples, between_knots


class MeasuredLift(NamedTuple):
    """Lift coefficient: the terms of `lift.measured_lift_coefficient`, at the knots of the drag."""

    mach: Array
    alpha: Array
    elevator: Array
    mach_alpha: Array
    alpha_elevator: Array
    pitch_rate: Array
    path_rate: float
    flap: float

    def predict(self, data: Samples) -> Array:
        """C_L of samples."""
        tables = (self.mach_alpha.ravel(), self.alpha_elevator.ravel(), self.pitch_rate)
        return np.asarray(
            _design(data, self.mach, self.alpha, self.elevator)
            @ np.concatenate([*tables, [self.path_rate, self.flap]])
        )


def _design(data: Samples, mach: Array, alpha: Array, elevator: Array) -> Array:
    at_alpha = hats(data.alpha, alpha)
    return np.hstack(
        [
            products(hats(data.mach, mach), at_alpha),
            products(at_alpha, hats(data.elevator, elevator)),
            at_alpha * data.pitch_rate[:, None],
            data.path_rate[:, None],
            data.flap[:, None],
        ]
    )


def fit_measured_lift(data: Samples, drag: AnglesDrag) -> MeasuredLift:
    """C_L, least squares of the residual.

    Args:
        data: samples, those in gusts among them.
        drag: whose knots are taken.
    """
    mach, alpha, elevator = drag.mach, drag.alpha, drag.elevator
    data = between_knots(data, mach)
    m, n, k = len(mach), len(alpha), len(elevator)
    sizes = np.cumsum([m * n, n * k, n, 1, 1])
    smooth = np.zeros(((m - 2) * n, sizes[-1]))
    smooth[:, : m * n] = second_differences(m, n)
    solution = solve(
        _design(data, mach, alpha, elevator),
        data.lift,
        data.share / np.mean(np.abs(data.lift)),
        [SMOOTH * smooth, RIDGE * np.eye(sizes[-1])],
    )
    table, elevator_table, pitch_rate, path_rate, flap = np.split(solution, sizes[:-1])
    return MeasuredLift(
        mach, alpha, elevator, table.reshape(m, n), elevator_table.reshape(n, k), pitch_rate,
        float(path_rate[0]), float(flap[0]),
    )  # fmt: skip
