"""Subset simulation against probabilities that are known exactly."""

import numpy as np
import pytest
from scipy.stats import norm

from ftc_jsb.campaign.subset import subset_simulation


@pytest.mark.parametrize(("bound", "dimensions"), [(2.0, 2), (3.5, 10)])
def test_linear_limit_state_in_normal_space(bound, dimensions):
    """P(sum z / sqrt(d) > bound) = Phi(-bound): the mean of 30 runs within three of its standard errors,
    and the stated coefficient of variation within a factor of 2 of the scatter of the runs.
    """

    def objective(points):
        return bound - norm.ppf(points).sum(axis=1) / np.sqrt(dimensions)

    runs = [subset_simulation(objective, dimensions, samples=400, seed=k) for k in range(30)]
    found = np.array([run.probability for run in runs])
    exact = norm.cdf(-bound)
    assert abs(found.mean() - exact) < 3.0 * found.std(ddof=1) / np.sqrt(30)
    scatter = found.std(ddof=1) / found.mean()
    stated = np.mean([run.coefficient_of_variation for run in runs])
    assert 0.5 < stated / scatter < 2.0
    if bound > 3.0:
        assert (
            np.mean([run.evaluations for run in runs]) < 0.1 * 10.0 / exact
        )  # of brute force at 30 %


def test_what_never_happens_has_no_probability_and_says_so():
    result = subset_simulation(lambda points: np.ones(len(points)), 3, samples=100, seed=1)
    assert result.probability <= 1.0
    assert result.evaluations <= 100 * 8
