"""Small linear systems by elimination, without allocation, with the pivot that failed."""

from ftc_jsb.compiled import compiled
from ftc_jsb.vocabulary.kernel_types import Matrix, Vector

SINGULAR = 1e-12  # pivot relative to the largest element of the matrix


@compiled
def solve_in_place(matrix: Matrix, vector: Vector) -> int:
    """Solve matrix x = vector by Gaussian elimination with row exchange; both are overwritten.

    Args:
        matrix: (n, n).
        vector: (n,), receives x.

    Returns:
        -1, or the number of the column that has no pivot.
    """
    n = vector.size
    largest = 0.0
    for i in range(n):
        for j in range(n):
            largest = max(largest, abs(matrix[i, j]))
    for j in range(n):
        pivot = j
        for i in range(j + 1, n):
            if abs(matrix[i, j]) > abs(matrix[pivot, j]):
                pivot = i
        if not abs(matrix[pivot, j]) > SINGULAR * largest:
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
