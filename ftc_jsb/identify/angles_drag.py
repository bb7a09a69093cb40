"""Fit of the drag coefficient from measured angles, surfaces and pitch rate."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ftc_jsb.identify.knots import at_most, knots_to_the_ends, mach_knots
from ftc_jsb.identify.regression import RIDGE, Array, hats, products, second_differences, solve
from ftc_jsb.identify.samples import Samples, between_knots
from ftc_jsb.point_mass.model import ALPHA_KNOTS, ELEVATOR_KNOTS, MACH_KNOTS

MACH_STEP = 0.025  # what is left of the drag there is its rise between knots
ALPHA_STEP = np.radians(1.0)
ELEVATOR_STEP = np.radians(12.5)
SMOOTH = 1e-4  # across Mach knots, which flights cover densely


class AnglesDrag(NamedTuple):
    """Drag coefficient from measured angles: the terms of `drag.measured_drag_coefficient`."""

    mach: Array
    alpha: Array
    elevator: Array
    mach_alpha: Array
    alpha_elevator: Array
    pitch_rate: Array
    flap: float
    sideslip: Array
    sideslip_squared: float

    def predict(self, data: Samples) -> Array:
        """C_D of samples."""
        return np.asarray(
            _angles_design(data, self.mach, self.alpha, self.elevator)
            @ np.concatenate(
                [
                    self.mach_alpha.ravel(),
                    self.alpha_elevator.ravel(),
                    self.pitch_rate,
                    self.sideslip,
                    [self.flap, self.sideslip_squared],
                ]
            )
        )

    def of_sideslip(self, data: Samples) -> Array:
        """The part of C_D that sideslip makes."""
        slope = hats(data.alpha, self.alpha) @ self.sideslip
        return np.asarray(slope * np.abs(data.sideslip) + self.sideslip_squared * data.sideslip**2)


def _angles_design(data: Samples, mach: Array, alpha: Array, elevator: Array) -> Array:
    at_alpha = hats(data.alpha, alpha)
    return np.hstack(
        [
            products(hats(data.mach, mach), at_alpha),
            products(at_alpha, hats(data.elevator, elevator)),
            at_alpha * data.pitch_rate[:, None],
            at_alpha * np.abs(data.sideslip)[:, None],
            data.flap[:, None],
            data.sideslip[:, None] ** 2,
        ]
    )


def fit_angles_drag(data: Samples, breaks: Sequence[float]) -> AnglesDrag:
    """C_D from Mach, alpha, elevator, pitch rate, flap and sideslip, relative residual."""
    flown = data
    mach = at_most(MACH_KNOTS, lambda step: mach_knots(flown.mach, breaks, step), MACH_STEP)
    alpha = at_most(ALPHA_KNOTS, lambda step: knots_to_the_ends(flown.alpha, step), ALPHA_STEP)
    data = between_knots(data, mach)
    elevator = at_most(
        ELEVATOR_KNOTS, lambda step: knots_to_the_ends(data.elevator, step), ELEVATOR_STEP
    )
    m, n, k = len(mach), len(alpha), len(elevator)
    sizes = np.cumsum([m * n, n * k, n, n, 1, 1])
    level = 1.0 / np.mean(data.drag)
    smooth = np.zeros(((m - 2) * n, sizes[-1]))
    smooth[:, : m * n] = second_differences(m, n)
    solution = solve(
        _angles_design(data, mach, alpha, elevator),
        data.drag,
        data.share / data.drag,
        [SMOOTH * level * smooth, RIDGE * np.eye(sizes[-1])],
    )
    table, elevator_table, pitch_rate, sideslip, flap, squared = np.split(solution, sizes[:-1])
    return AnglesDrag(
        mach, alpha, elevator, table.reshape(m, n), elevator_table.reshape(n, k), pitch_rate,
        float(flap[0]), sideslip, float(squared[0]),
    )  # fmt: skip
