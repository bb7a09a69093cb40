"""Cholesky factor and solution for the filters' small matrices, without allocation."""

import math

from ftc_jsb.compiled import compiled
from ftc_jsb.vocabulary.kernel_types import Matrix, Vector

PIVOT_FLOOR = 1e-14  # relative to the diagonal element: what rounding may have left of it


@compiled
def cholesky(matrix: Matrix, size: int, factor: Matrix) -> int:
    """Lower factor L of the leading block of a symmetric `matrix`: L L^T = matrix.

    A pivot that rounding has driven below `PIVOT_FLOOR` of its diagonal element is held there, so
    that the factor exists for every covariance the filters can reach.

    Args:
        matrix: (>= size, >= size), only the lower triangle is read.
        size: of the block.
        factor: (>= size, >= size), receives L; its upper triangle is set to zero.

    Returns:
        How many pivots were held.
    """
    held = 0
    for j in range(size):
        pivot = matrix[j, j]
        for k in range(j):
            pivot -= factor[j, k] * factor[j, k]
        floor = PIVOT_FLOOR * abs(matrix[j, j]) + 1e-300
        if not pivot > floor:
            pivot = floor
            held += 1
        root = math.sqrt(pivot)
        factor[j, j] = root
        for i in range(j + 1, size):
            value = matrix[i, j]
            for k in range(j):
                value -= factor[i, k] * factor[j, k]
            factor[i, j] = value / root
            factor[j, i] = 0.0
    return held


@compiled
def cholesky_solve(factor: Matrix, size: int, vector: Vector) -> None:
    """Solve L L^T x = `vector` in place, L as made by `cholesky`."""
    for i in range(size):
        value = vector[i]
        for k in range(i):
            value -= factor[i, k] * vector[k]
        vector[i] = value / factor[i, i]
    for j in range(size):
        i = size - 1 - j
        value = vector[i]
        for k in range(i + 1, size):
            value -= factor[k, i] * vector[k]
        vector[i] = value / factor[i, i]
