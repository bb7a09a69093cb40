"""The small Cholesky factor against NumPy, and on matrices that have none."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from ftc_jsb.estimation.cholesky import cholesky, cholesky_solve

ROOTS = arrays(float, (4, 4), elements=st.floats(-1.0, 1.0))


@given(root=ROOTS)
def test_factor_and_solution_are_numpys(root):
    """Condition numbers up to 1e4, so 1e-9 relative."""
    matrix = root @ root.T + 0.01 * np.eye(4)
    factor, vector = np.zeros((4, 4)), np.arange(1.0, 5.0)
    assert cholesky(matrix, 4, factor) == 0
    np.testing.assert_allclose(factor, np.linalg.cholesky(matrix), rtol=1e-9, atol=1e-12)
    cholesky_solve(factor, 4, vector)
    np.testing.assert_allclose(vector, np.linalg.solve(matrix, np.arange(1.0, 5.0)), rtol=1e-6)


def test_matrix_without_a_factor_gets_a_finite_one():
    """An indefinite matrix, and one that is zero: pivots are held, nothing is nan."""
    factor = np.zeros((4, 4))
    assert cholesky(np.diag([1.0, -1.0, 1.0, 0.0]), 4, factor) == 2
    assert np.isfinite(factor).all()
