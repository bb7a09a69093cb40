"""Whether the filter's covariance is the truth, and stays a covariance for a million steps."""

from typing import Any

import numpy as np

from ftc_jsb.compiled import compiled
from ftc_jsb.estimation.cholesky import cholesky
from ftc_jsb.estimation.process import FILTER, Forcing
from ftc_jsb.estimation.ukf import predict_unscented
from ftc_jsb.estimation.update import update
from ftc_jsb.point_mass.model import at_condition
from tests.point_mass.models import PAPER
from validation.noisy import noisy_flights


def test_filter_is_consistent_over_200_noisy_flights():
    """NEES and NIS inside their 95 % bands for at least 90 % of the time; one channel, and three."""
    for channels in (1, 3):
        nees, nis = noisy_flights(channels).inside()
        assert nees >= 0.90
        assert nis >= 0.90


def test_filter_that_believes_its_sensors_too_much_is_found_out():
    """R taken for half of what it is: the same measure leaves the bands for most of the time."""
    nees, nis = noisy_flights(1, flights=100, believed=0.5).inside()
    assert nees < 0.5
    assert nis < 0.5


@compiled
def _endure(model: Any, filters: Any, random: Any, q: Any, r: Any, steps: int) -> int:
    """Steps with inputs and measurements of every kind; returns those that spoilt the covariance."""
    f = filters[0]
    factor, y = np.zeros((6, 6)), np.zeros(3)
    spoilt = 0
    for i in range(steps):
        a = random[i % random.shape[0]]
        forcing = Forcing(110e3 * a[0], -3.0 + 10.0 * a[1], 6.0 * a[2] - 3.0, False, 0.0, 0.0)
        at = at_condition(model[0], 300.0, 3048.0)
        predict_unscented(f, at, forcing, q, 3.0, 0.01)
        y[0], y[1], y[2] = 250.0 + 100.0 * a[3], 0.4 * a[4] - 0.2, a[5] - 0.5
        if a[0] < 0.02:
            y[0] = np.nan
        update(f, y, r, 0.0, 1, 0.05)
        held = cholesky(f.covariance, f.count, factor)
        for j in range(f.count):
            for k in range(j):
                if f.covariance[j, k] != f.covariance[k, j]:
                    held += 1
        if held > 0 or not np.isfinite(f.estimate[0]):
            spoilt += 1
    return spoilt


def test_covariance_stays_one_for_a_million_steps():
    """Six states (centre weight -1), the printed Q and R, inputs at random: never not positive definite."""
    filters = np.zeros(1, FILTER)
    filters["count"] = 6
    filters["channel"][0] = [0, 1, 2]
    filters["estimate"][0] = [300.0, 0.0, 0.0, 1.0, 1.0, 1.0]
    filters["covariance"][0] = np.diag([1e-6, 1e-8, 1e-6, 1e-4, 1e-4, 1e-4])
    random = np.random.default_rng(3).uniform(size=(9973, 6))
    q, r = np.array([1e-10, 1e-10, 1e-3, 1e-10, 1e-10, 1e-10]), np.array([1e-10, 1e-10, 1e-3])
    assert _endure(PAPER, filters, random, q, r, 1_000_000) == 0
