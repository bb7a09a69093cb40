"""Many flights in one call are the flights that `fly` flies."""

import numpy as np
import pytest

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.errors import ScenarioError
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.batch import fly_batch
from ftc_jsb.simulation.fly import fly


def test_cases_of_a_batch_are_the_flights_of_fly():
    """Cases that differ in fault, sensors, aircraft and what the loop knows of it: to rounding of sums."""
    given = (
        [],
        ["fault[0].effectiveness=0.5", "seed=3", "sensors.profile='tactical'", "loop.name='robust'"],
        ["model='identified'", "loop.name='no-ftc'", "initial.altitude=4000"],
        ["model='identified'", "model_error.mass=1.1"],
    )  # fmt: skip
    scenarios = [load_scenario("paper", [*changes, "duration=25"]) for changes in given]
    for summary, scenario in zip(fly_batch(scenarios), scenarios, strict=True):
        flight = fly(scenario)
        metrics = flight_metrics(flight)
        assert summary["rows"] == flight.record.size
        assert summary["reason"] == 0
        found = {
            "rmse_airspeed_mps": summary["rmse_airspeed"],
            "rmse_flight_path_deg": np.degrees(summary["rmse_flight_path"]),
            "rmse_heading_deg": np.degrees(summary["rmse_heading"]),
            "peak_error_airspeed_mps": summary["peak_error_airspeed"],
            "peak_load_factor": summary["peak_load_factor"],
        }
        for name, value in found.items():
            assert value == pytest.approx(metrics[name], rel=1e-9), name


def test_a_case_without_an_estimator_has_no_error_of_the_estimate():
    """Not the one of the case before."""
    scenarios = [
        load_scenario("paper", ["duration=5", f"loop.name={n}"]) for n in ("ftc", "integral")
    ]
    one, other = fly_batch(scenarios)
    assert np.isfinite(one["effectiveness_error"])
    assert np.isnan(other["effectiveness_error"])


def test_a_batch_of_nothing_is_empty():
    assert fly_batch([]).size == 0


def test_what_does_not_fly_in_a_batch_is_refused():
    one = load_scenario("paper", ["duration=1"])
    with pytest.raises(ScenarioError, match=r"one reference, duration and loop\.rate"):
        fly_batch([one, load_scenario("paper", ["duration=2"])])
    with pytest.raises(ScenarioError, match="point masses with built-in loops"):
        fly_batch([load_scenario("paper", ["loop.name='tests.control.my_loop:PullingLoop'"])])
