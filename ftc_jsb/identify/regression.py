"""Linear regression on tables: hat functions, ridge and smoothness across knots."""

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

RIDGE = 1e-5  # of relative drag: decides only what no flight has seen


def hats(values: Array, knots: Array) -> Array:
    """(samples, knots): weights of linear interpolation, clamped at the ends."""
    columns = [np.interp(values, knots, unit) for unit in np.eye(len(knots))]
    return np.stack(columns, axis=1)


def products(left: Array, right: Array) -> Array:
    """(samples, m n): all products of a column of `left` (m) and one of `right` (n), row-major."""
    return np.asarray((left[:, :, None] * right[:, None, :]).reshape(len(left), -1))


def second_differences(rows: int, columns: int) -> Array:
    """Second differences down the rows of a (rows, columns) table, as a penalty on its elements."""
    penalty = np.zeros((max(rows - 2, 0), columns, rows, columns))
    for i in range(rows - 2):
        for j in range(columns):
            penalty[i, j, i : i + 3, j] = (1.0, -2.0, 1.0)
    return np.asarray(penalty.reshape(-1, rows * columns))


def solve(design: Array, target: Array, weight: Array, penalties: list[Array]) -> Array:
    """Coefficients of weighted least squares; each row of a penalty is wanted to be zero.

    Args:
        design: (samples, coefficients).
        target: (samples,).
        weight: (samples,), on the residual.
        penalties: matrices (rows, coefficients), scaled by the caller against residuals of 1.
    """
    scale = np.sqrt(len(design))
    matrix = np.vstack([design * weight[:, None], *(scale * p for p in penalties)])
    right = np.concatenate([target * weight, np.zeros(len(matrix) - len(design))])
    solution, *_ = np.linalg.lstsq(matrix, right, rcond=None)
    return np.asarray(solution)
