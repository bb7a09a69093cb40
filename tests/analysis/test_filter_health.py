"""Health of the filter on innovations whose distribution is known."""

import numpy as np
import pytest
from scipy.stats import chi2

from ftc_jsb.analysis.filter_health import NIS_BOUND, estimator_health
from ftc_jsb.recording.columns import ROW


def consistent(samples: int, believed: float) -> np.ndarray:
    """Innovations of unit variance, whose filter believes in another standard deviation."""
    random = np.random.default_rng(7)
    record = np.full(samples, np.nan).astype(ROW)
    record["innovation_squared"] = 0.0
    for name in ("airspeed", "flight_path_angle", "heading"):
        white = random.standard_normal(samples)
        record[f"{name}_innovation"], record[f"{name}_innovation_std"] = white, believed
        record["innovation_squared"] += (white / believed) ** 2
    return record


def test_bound_is_that_of_chi_squared():
    assert pytest.approx(chi2.ppf(0.95, df=3), abs=1e-3) == NIS_BOUND


def test_consistent_filter_is_inside_95_percent_of_the_time():
    """40 000 samples: the part inside has a standard deviation of 0.1 %."""
    found = estimator_health(consistent(40_000, 1.0))
    assert found["nis_inside_fraction"] == pytest.approx(0.95, abs=0.005)
    assert found["nis_mean"] == pytest.approx(3.0, abs=0.05)
    for name in ("airspeed", "flight_path_angle", "heading"):
        assert found[f"innovation_{name}_inside_fraction"] == pytest.approx(0.9545, abs=0.005)


def test_filter_that_is_too_sure_is_found_out():
    found = estimator_health(consistent(40_000, 0.5))
    assert found["nis_inside_fraction"] < 0.5
    assert found["innovation_airspeed_peak_sigmas"] > 7.0


def test_nothing_estimated_is_unknown():
    record = np.full(10, np.nan).astype(ROW)
    assert set(estimator_health(record).values()) == {None}
