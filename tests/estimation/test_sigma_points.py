"""Points drawn from a mean and covariance have that mean and covariance, whatever the weights' signs."""

from typing import Any

import numpy as np
import pytest

from ftc_jsb.compiled import compiled
from ftc_jsb.estimation.sigma_points import (
    covariance_of,
    cross_covariance_of,
    draw_points,
    mean_of,
    weights_of,
)

ROOM = 6  # states that the arrays have room for


@compiled
def _there_and_back(
    mean: Any, covariance: Any, size: int, spread: float, output: Any, found: Any
) -> float:
    """Draw, go through y = output x, and take mean, covariance and cross covariance again."""
    points, factor = np.zeros((2 * ROOM + 1, ROOM)), np.zeros((ROOM, ROOM))
    weights = weights_of(size, spread)
    draw_points(mean, covariance, size, spread, factor, points)
    mean_of(points, weights, size, found.mean)
    covariance_of(points, found.mean, weights, size, found.covariance)
    seen = np.ascontiguousarray(points[:, :size]) @ np.ascontiguousarray(output.T)
    output_mean = np.zeros(output.shape[0])
    mean_of(seen, weights, output.shape[0], output_mean)
    cross_covariance_of(points, found.mean, seen, output_mean, weights, found.cross)
    return weights.centre + (weights.points - 1) * weights.other


@pytest.mark.parametrize("size", [2, 4, 6])  # centre weight 1/3, -1/3, -1
def test_moments_survive(size):
    """Mean, P and P_xy = P H^T to rounding: 1e-12 of elements of order one."""
    random = np.random.default_rng(size)
    root = random.normal(size=(size, size))
    covariance = np.zeros((ROOM, ROOM))
    covariance[:size, :size] = root @ root.T + 0.1 * np.eye(size)
    mean, output = np.zeros(ROOM), random.normal(size=(2, size))
    mean[:size] = random.normal(size=size)
    moments = np.dtype(
        [
            ("mean", float, (ROOM,)),
            ("covariance", float, (ROOM, ROOM)),
            ("cross", float, (size, 2)),
        ]
    )
    found = np.zeros(1, moments)
    total = _there_and_back(mean, covariance, size, 3.0, output, found[0])
    assert total == pytest.approx(1.0, abs=1e-15)
    np.testing.assert_allclose(found[0]["mean"], mean, atol=1e-12)
    np.testing.assert_allclose(found[0]["covariance"], covariance, atol=1e-12)
    expected = covariance[:size, :size] @ output.T
    np.testing.assert_allclose(found[0]["cross"], expected, atol=1e-12)
