"""Small linear systems by elimination, without allocation, with the pivot that failed."""

from ftc_jsb.compiled import compiled
from ftc_jsb.vocabulary.kernel_types import Matrix, Vector

SINGULAR = 1e-12  # pivot over the largest element of its column, rows scaled to 1
LEAST = 1e-280  # below it an element counts as zero: its inverse would leave the finite numbers


@compiled
def solve_in_place(matrix: Matrix, vector: Vector) -> int:
    """Solve matrix x = vector by Gaussian elimination with row exchange; both are overwritten.

    Rows are scaled to a largest element of 1 and a pivot is judged by its column, so that units of
    inputs and outputs decide nothing. How small a whole column may be only the size of its input can
    tell: whoever knows that judges the step that comes out.

    Args:
        matrix: (n, n).
        vector: (n,), receives x.

    Returns:
        -1, or the number of the column that has no pivot.
    """
    n = vector.size
    for i in range(n):
        largest = _largest(matrix[i])
        if largest > LEAST:
            for j in range(n):
                matrix[i, j] /= largest
            vector[i] /= largest
    for j in range(n):
        column = _largest(matrix[:, j])
        pivot = j
        for i in range(j + 1, n):
            if abs(matrix[i, j]) > abs(matrix[pivot, j]):
                pivot = i
        if not abs(matrix[pivot, j]) > SINGULAR * column + LEAST:
            return j
        if pivot != j:
            for k in range(n):
                matrix[j, k], matrix[pivot, k] = matrix[pivot, k], matrix[j, k]
            vector[j], vector[pivot] = vector[pivot], vector[j]
        for i in range(j + 1, n):
            factor = matrix[i, j] / matrix[j, j]
            for k in range(j, n):
                matrix[i, k] -= factor * matrix[j, k]
            vector[i] -= factor * vector[j]
    for j in range(n):
        i = n - 1 - j
        for k in range(i + 1, n):
            vector[i] -= matrix[i, k] * vector[k]
        vector[i] /= matrix[i, i]
    return -1


@compiled
def _largest(values: Vector) -> float:
    """The largest absolute value."""
    largest = 0.0
    for value in values:
        largest = max(largest, abs(value))
    return largest
