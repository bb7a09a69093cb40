"""Joint estimation (20)-(34) of state and faults for any system, reduced form, nonlinear outputs too.

For nonlinear h the sigma points are drawn again from the predicted covariance, Q included, before
they go through h. The augmented form keeps the propagated points, so that for nonlinear h the two
differ at second order; `augmented.py` is that form, and docs/theory.md says by how much.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled_in_memory, inlined
from ftc_jsb.estimation.cholesky import cholesky, cholesky_solve
from ftc_jsb.estimation.sigma_points import (
    add_noise,
    covariance_of,
    cross_covariance_of,
    draw_points,
    mean_of,
    weights_of,
)
from ftc_jsb.theory.discrete_model import make_propagate
from ftc_jsb.theory.generated import Kernels
from ftc_jsb.vocabulary.kernel_types import Matrix, Vector

Array = npt.NDArray[np.float64]


class FilterSettings(NamedTuple):
    """Numbers of the filter, constant over a flight."""

    process_noise: Array  # (states + faults,), diagonal of Q a step
    measurement_noise: Array  # (outputs,), diagonal of R
    spread: float  # n_a + kappa of (26), (29)
    floor: float  # the fault states are kept in [floor, 1]; 0 = not at all
    dt: float  # [s]


class Scratch(NamedTuple):
    """Working space of one step."""

    factor: Array  # (n, n)
    points: Array  # (2 n + 1, n)


def make_filter(kernels: Kernels, states: int, faults: int, outputs: int) -> Callable[..., None]:
    """The compiled filter of a system over z = [x, k].

    The result is `step(z, cov, u, y, p, settings)`: prediction over a sample under a held u and
    correction by y, in place. z (states + faults,), cov its covariance; u (inputs,); y (outputs,), not
    corrected by if an element of it is not finite; p (parameters,); settings: a `FilterSettings`.
    """
    predict = _make_predict(kernels, states, faults)
    update = _make_update(kernels, states, faults, outputs)
    n = states + faults

    @compiled_in_memory
    def step(
        z: Vector, cov: Matrix, u: Vector, y: Vector, p: Vector, settings: FilterSettings
    ) -> None:
        scratch = Scratch(np.zeros((n, n)), np.empty((2 * n + 1, n)))
        predict(z, cov, u, p, settings, scratch)
        update(z, cov, y, p, settings, scratch)

    return step


def _make_predict(kernels: Kernels, states: int, faults: int) -> Callable[..., None]:
    propagate = make_propagate(kernels)
    n = states + faults

    @compiled_in_memory
    def predict(
        z: Vector, cov: Matrix, u: Vector, p: Vector, settings: FilterSettings, scratch: Scratch
    ) -> None:
        """Prediction (26)-(30): z and cov go from k-1 to k."""
        points, stages = scratch.points, np.empty((5, states))
        weights = weights_of(n, settings.spread)  # (29)
        draw_points(z, cov, n, settings.spread, scratch.factor, points)  # (26)
        for a in range(2 * n + 1):  # (27)
            propagate(points[a, :states], u, points[a, states:], p, settings.dt, stages)
        mean_of(points, weights, n, z)  # (28)
        covariance_of(points, z, weights, n, cov)  # (30)
        add_noise(cov, settings.process_noise, n)

    return predict


def _make_update(kernels: Kernels, states: int, faults: int, outputs: int) -> Callable[..., None]:
    observe = kernels.outputs
    n, m = states + faults, outputs

    @compiled_in_memory
    def update(
        z: Vector, cov: Matrix, y: Vector, p: Vector, settings: FilterSettings, scratch: Scratch
    ) -> None:
        """Correction (31)-(34) by y, and the bounds of the fault states."""
        for i in range(m):
            if not np.isfinite(y[i]):
                return
        points, seen = scratch.points, np.empty((2 * n + 1, m))
        mean, pyy, pxy = np.empty(m), np.zeros((m, m)), np.zeros((n, m))
        weights = weights_of(n, settings.spread)  # (29)
        draw_points(z, cov, n, settings.spread, scratch.factor, points)
        for a in range(2 * n + 1):  # (31)
            observe(points[a, :states], p, seen[a])
        mean_of(seen, weights, m, mean)  # (32)
        covariance_of(seen, mean, weights, m, pyy)  # (33)
        add_noise(pyy, settings.measurement_noise, m)
        cross_covariance_of(points, z, seen, mean, weights, pxy)
        condition_on(z, cov, y - mean, pyy, pxy)  # (34)
        if settings.floor > 0.0:
            for j in range(states, n):
                z[j] = min(max(z[j], settings.floor), 1.0)

    return update


@inlined
def condition_on(z: Vector, cov: Matrix, innovation: Vector, pyy: Matrix, pxy: Matrix) -> None:
    """(34): K = P_xy P_yy^-1; the estimate gains K (y - y^), the covariance loses K P_yy K^T.

    Args:
        z, cov: (n,) and (n, n), changed in place.
        innovation: y less its prediction (32), (m,).
        pyy, pxy: of (33), (m, m) and (n, m).
    """
    n, m = pxy.shape
    root, gain = np.zeros((m, m)), pxy.copy()
    cholesky(pyy, m, root)
    for j in range(n):
        cholesky_solve(root, m, gain[j])
    for j in range(n):
        for i in range(m):
            z[j] += gain[j, i] * innovation[i]
    for j in range(n):
        for k in range(j + 1):
            total = cov[j, k]
            for i in range(m):
                total -= gain[j, i] * pxy[k, i]
            cov[j, k] = total
            cov[k, j] = total
