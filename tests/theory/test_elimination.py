"""Small systems are solved whatever their units, and a matrix that is singular says so."""

import numpy as np
import pytest

from ftc_jsb.theory.elimination import solve_in_place


@pytest.mark.parametrize("rows", [1.0, 1e-9, 1e9])
@pytest.mark.parametrize("columns", [1.0, 1e-7, 1e7])
def test_solution_does_not_depend_on_units(rows, columns):
    """A random matrix of 4 whose second row and column are in other units: 1e-9 relative."""
    random = np.random.default_rng(1)
    matrix, x = random.standard_normal((4, 4)), random.standard_normal(4)
    scaled = matrix.copy()
    scaled[1] *= rows
    scaled[:, 1] *= columns
    x[1] /= columns
    vector = scaled @ x
    assert solve_in_place(scaled, vector) == -1
    np.testing.assert_allclose(vector, x, rtol=1e-9)


@pytest.mark.parametrize(
    ("matrix", "column"),
    [
        ([[1e-300]], 0),
        ([[0.0]], 0),
        ([[1.0, 1.0], [1.0, 1.0 + 1e-14]], 1),
        ([[1e9, 1e9], [1e-9, 1e-9]], 1),
        ([[1.0, 0.0], [2.0, 0.0]], 1),
    ],
)
def test_singular_matrix_names_its_column(matrix, column):
    assert solve_in_place(np.array(matrix), np.ones(len(matrix))) == column
