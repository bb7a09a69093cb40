"""Joint estimation (20)-(34) of state and faults for any system, reduced form, nonlinear outputs too.

For nonlinear h the sigma points are drawn again from the predicted covariance, Q included, before
they go through h. The augmented form keeps the propagated points, so that for nonlinear h the two
differ at second order; `estimation/augmented.py` is that form, and docs/theory.md says by how much.

The covariance of (34) is formed from the points, P = sum W (a - K b)(a - K b)^T + K R K^T, a and b
being how far a point and its output are from their means. That equals P - K P_yy K^T for this K, and
is a sum of squares wherever no weight is negative: Joseph's form for sigma points.
"""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled
from ftc_jsb.estimation.cholesky import cholesky, cholesky_solve
from ftc_jsb.estimation.sigma_points import (
    Weights,
    add_noise,
    covariance_of,
    cross_covariance_of,
    draw_points,
    mean_of,
    weights_of,
)
from ftc_jsb.vocabulary.kernel_types import Matrix, Vector

from .arrays import copy, fill
from .discrete_model import propagate
from .system import FALLIBLE, INPUTS, MEASURED, STATES, outputs

Array = npt.NDArray[np.float64]
ESTIMATED = STATES + len(FALLIBLE)  # length of z
SOUND, NOT_DEFINITE, INNOVATION_NOT_DEFINITE = 0, 1, 2
NEARBY = 1e-6  # spread of the points by which the extended filter differentiates


class FilterSettings(NamedTuple):
    """Numbers of the filter, constant over a flight."""

    process_noise: Array  # (states + faults,), diagonal of Q a step
    measurement_noise: Array  # (measured,), diagonal of R
    spread: float  # n_a + kappa of (26), (29); below states + faults the centre weight is negative
    floor: float  # the fault states are kept in [floor, 1]; 0 = not at all
    dt: float  # [s]
    extended: bool  # linearise at the mean, as the extended Kalman filter does


@compiled
def estimate(
    z: Vector, cov: Matrix, u: Vector, y: Vector, p: Vector, settings: FilterSettings
) -> int:
    """Prediction over a sample under a held u and correction by y, in place.

    Args:
        z: (states + faults,).
        cov: its covariance.
        u: (inputs,).
        y: (measured,); elements that are not finite are left out of the correction.
        p: (parameters,).
        settings: of the filter.

    Returns:
        SOUND, or which covariance has no Cholesky factor: that of the state, or of the innovation.
    """
    factor, points = np.zeros((ESTIMATED, ESTIMATED)), np.empty((2 * ESTIMATED + 1, ESTIMATED))
    spread = NEARBY if settings.extended else settings.spread
    weights = weights_of(ESTIMATED, spread)  # (29)
    if draw_points(z, cov, ESTIMATED, spread, factor, points) > 0:  # (26)
        return NOT_DEFINITE
    _predict(z, cov, u, p, settings, points, weights)
    if draw_points(z, cov, ESTIMATED, spread, factor, points) > 0:
        return NOT_DEFINITE
    status = _correct(z, cov, y, p, settings, points, weights)
    if settings.floor > 0.0:
        for j in range(STATES, ESTIMATED):
            z[j] = min(max(z[j], settings.floor), 1.0)
    return status


@compiled
def _predict(
    z: Vector,
    cov: Matrix,
    u: Vector,
    p: Vector,
    settings: FilterSettings,
    points: Matrix,
    weights: Weights,
) -> None:
    """Prediction (27)-(30): z and cov go from k-1 to k."""
    stages, k = np.empty((5, STATES)), np.ones(INPUTS)
    for a in range(2 * ESTIMATED + 1):  # (27)
        effectiveness_of(points[a], k)
        propagate(False, points[a, :STATES], u, k, p, settings.dt, stages)
    if settings.extended:
        copy(points[0], z)
    else:
        mean_of(points, weights, ESTIMATED, z)  # (28)
    covariance_of(points, z, weights, ESTIMATED, cov)  # (30)
    add_noise(cov, settings.process_noise, ESTIMATED)


@compiled
def _correct(
    z: Vector,
    cov: Matrix,
    y: Vector,
    p: Vector,
    settings: FilterSettings,
    points: Matrix,
    weights: Weights,
) -> int:
    """Correction (31)-(34) by what there is of y."""
    place = np.empty(MEASURED, np.int64)
    m = 0
    for i in range(MEASURED):
        if math.isfinite(y[i]):
            place[m] = i
            m += 1
    if m == 0:
        return SOUND
    whole, noise = np.empty(MEASURED), np.empty(m)
    seen, innovation = np.empty((2 * ESTIMATED + 1, m)), np.empty(m)
    for a in range(2 * ESTIMATED + 1):  # (31)
        outputs(points[a, :STATES], p, whole)
        for i in range(m):
            seen[a, i] = whole[place[i]]
    mean = np.empty(m)
    copy(seen[0], mean)
    if not settings.extended:
        mean_of(seen, weights, m, mean)  # (32)
    for i in range(m):
        noise[i] = settings.measurement_noise[place[i]]
        innovation[i] = y[place[i]] - mean[i]
    return _condition(z, cov, innovation, noise, (points, seen, mean), weights)


@compiled
def _condition(
    z: Vector,
    cov: Matrix,
    innovation: Vector,
    noise: Vector,
    drawn: tuple[Matrix, Matrix, Vector],
    weights: Weights,
) -> int:
    """(33), (34): z gains K (y - y^), cov is formed anew from the points."""
    points, seen, mean = drawn
    n, m = ESTIMATED, innovation.size
    pyy, pxy, root = np.zeros((m, m)), np.zeros((n, m)), np.zeros((m, m))
    covariance_of(seen, mean, weights, m, pyy)
    add_noise(pyy, noise, m)
    cross_covariance_of(points, z, seen, mean, weights, pxy)
    if cholesky(pyy, m, root) > 0:
        return INNOVATION_NOT_DEFINITE
    gain = pxy  # K = P_xy P_yy^-1, row by row
    for j in range(n):
        cholesky_solve(root, m, gain[j])
    away = np.empty(n)
    for j in range(n):
        fill(cov[j], 0.0)
    for a in range(2 * n + 1):
        weight = weights.centre if a == 0 else weights.other
        for j in range(n):
            away[j] = points[a, j] - z[j]
            for i in range(m):
                away[j] -= gain[j, i] * (seen[a, i] - mean[i])
        for j in range(n):
            for b in range(n):
                cov[j, b] += weight * away[j] * away[b]
    for j in range(n):
        for b in range(n):
            for i in range(m):
                cov[j, b] += gain[j, i] * noise[i] * gain[b, i]
    for j in range(n):
        for i in range(m):
            z[j] += gain[j, i] * innovation[i]
    return SOUND


@compiled
def effectiveness_of(z: Vector, k: Vector) -> None:
    """The factors k of every input, of which z holds those that are estimated; others stay."""
    for a in range(len(FALLIBLE)):
        k[FALLIBLE[a]] = z[STATES + a]
