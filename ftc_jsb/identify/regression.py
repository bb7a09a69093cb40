"""Linear regression on tables: hat functions, ridge and smoothness across knots."""

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

REFINEMENTS = 6  # of the normal equations' solution, which alone would lose half of the digits
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

    A sample touches a few coefficients of a table, so that the normal equations of sparse columns, scaled to
    equal size, take seconds where an orthogonal factor takes minutes; residuals of the samples refine them.
    Knots that only penalties hold may be too much for them: then the orthogonal factor is taken.

    Args:
        design: (samples, coefficients).
        target: (samples,).
        weight: (samples,), on the residual.
        penalties: matrices (rows, coefficients), scaled by the caller against residuals of 1.
    """
    from scipy.linalg import cho_factor, cho_solve
    from scipy.sparse import csr_array, diags_array, vstack

    scale = np.sqrt(len(design))
    rows = [csr_array(design * weight[:, None]), *(csr_array(scale * p) for p in penalties)]
    matrix = csr_array(vstack(rows))
    right = np.concatenate([target * weight, np.zeros(matrix.shape[0] - len(design))])
    norms = np.sqrt(np.asarray(matrix.power(2).sum(axis=0)).ravel())
    unit = matrix @ diags_array(1.0 / norms)
    try:
        factor = cho_factor((unit.T @ unit).toarray())
    except np.linalg.LinAlgError:
        return np.asarray(np.linalg.lstsq(unit.toarray(), right, rcond=None)[0] / norms)
    solution = np.zeros(len(norms))
    for _ in range(REFINEMENTS):
        solution += cho_solve(factor, unit.T @ (right - unit @ solution))
    return np.asarray(solution / norms)
