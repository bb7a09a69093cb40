"""Sigma points of the unscented transform, their weights, mean and covariance: (26), (28)-(30), (32), (33).

They are shared by the filter that flies (`ukf.py`) and the one for any system
(`theory/joint_filter.py`), both of the reduced form: 2n + 1 points of the n states, with the spread
n_a + kappa of the augmented vector. Arrays may be larger than what is in use, so that a filter with
fewer states than its record has room for needs no copies; nothing is allocated.
"""

from typing import NamedTuple

from ftc_jsb.compiled import inlined
from ftc_jsb.estimation.cholesky import cholesky
from ftc_jsb.vocabulary.kernel_types import Matrix, Vector


class Weights(NamedTuple):
    """Weights (29) of a set of sigma points; they add up to 1."""

    points: int  # how many, 2n + 1
    centre: float  # of the first point, negative where n exceeds the spread
    other: float  # of each of the others


@inlined
def weights_of(size: int, spread: float) -> Weights:
    """(29): W_0 = 1 - n / (n_a + kappa), W_i = 1 / (2 (n_a + kappa)).

    Args:
        size: n, of the states.
        spread: n_a + kappa.
    """
    return Weights(2 * size + 1, 1.0 - size / spread, 0.5 / spread)


@inlined
def draw_points(
    mean: Vector, covariance: Matrix, size: int, spread: float, factor: Matrix, points: Matrix
) -> int:
    """(26): the mean, and the mean plus and minus each column of the root of (n_a + kappa) P.

    Args:
        mean: (>= n,).
        covariance: P, (>= n, >= n), only the lower triangle is read.
        size: n.
        spread: n_a + kappa.
        factor: (>= n, >= n), receives the Cholesky factor of P.
        points: (>= 2n + 1, >= n), receives a point in each row.

    Returns:
        How many pivots of the factor were held.
    """
    held = cholesky(covariance, size, factor)
    scale = spread**0.5
    for i in range(size):
        points[0, i] = mean[i]
        for j in range(size):
            offset = scale * factor[i, j]
            points[1 + j, i] = mean[i] + offset
            points[1 + size + j, i] = mean[i] - offset
    return held


@inlined
def mean_of(points: Matrix, weights: Weights, size: int, mean: Vector) -> None:
    """(28), and (32) for points of the output.

    It is formed as a mean of differences: no cancellation with a negative centre weight.

    Args:
        points: (>= weights.points, >= size), a point in each row.
        weights: of the points.
        size: of a point.
        mean: (>= size,), receives the mean.
    """
    for i in range(size):
        total = 0.0
        for k in range(1, weights.points):
            total += points[k, i] - points[0, i]
        mean[i] = points[0, i] + weights.other * total


@inlined
def covariance_of(
    points: Matrix, mean: Vector, weights: Weights, size: int, covariance: Matrix
) -> None:
    """(30), and P_yy of (33) for points of the output; the noise, Q or R, is not in it.

    Args:
        points: (>= weights.points, >= size), a point in each row.
        mean: (>= size,), of the points.
        weights: of the points.
        size: of a point.
        covariance: (>= size, >= size), receives the covariance.
    """
    for i in range(size):
        for j in range(i + 1):
            total = weights.centre * (points[0, i] - mean[i]) * (points[0, j] - mean[j])
            for k in range(1, weights.points):
                total += weights.other * (points[k, i] - mean[i]) * (points[k, j] - mean[j])
            covariance[i, j] = total
            covariance[j, i] = total


@inlined
def cross_covariance_of(
    points: Matrix,
    mean: Vector,
    outputs: Matrix,
    output_mean: Vector,
    weights: Weights,
    cross: Matrix,
) -> None:
    """P_xy of (33).

    Args:
        points: (>= weights.points, >= n), a point of the state in each row.
        mean: (>= n,), of the points.
        outputs: (>= weights.points, >= m), the output of each point.
        output_mean: (>= m,), of the outputs.
        weights: of the points.
        cross: (n, m), receives the covariance of state and output.
    """
    for i in range(cross.shape[0]):
        for j in range(cross.shape[1]):
            total = weights.centre * (points[0, i] - mean[i]) * (outputs[0, j] - output_mean[j])
            for k in range(1, weights.points):
                away = outputs[k, j] - output_mean[j]
                total += weights.other * (points[k, i] - mean[i]) * away
            cross[i, j] = total


@inlined
def add_noise(covariance: Matrix, noise: Vector, size: int) -> None:
    """Q of (30), or R of (33): what the noise part of the augmented points adds, which is white.

    Args:
        covariance: (>= size, >= size), changed in place.
        noise: (>= size,), diagonal of Q or R.
        size: of the state or output.
    """
    for i in range(size):
        covariance[i, i] += noise[i]
