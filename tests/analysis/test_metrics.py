"""Metrics on recordings made by hand, where every number is known."""

import json

import numpy as np
import pytest

from ftc_jsb.analysis.effectiveness_estimate import judged, unobservable
from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.analysis.verdict import passed
from ftc_jsb.recording.flight import Flight, Outcome
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.assembly import blank_recording
from ftc_jsb.simulation.fly import fly

SCENARIO = load_scenario("paper", ["limits={}"])


def flight(**columns):
    record = blank_recording(SCENARIO)
    for name in ("airspeed", "flight_path_angle", "heading"):
        record[name] = record[f"{name}_ref"] = 0.0
    record["fault_declared"] = 0.0
    record["outside_range"] = 0.0
    record["thrust_saturated"] = record["load_factor_saturated"] = 0.0
    for name, values in columns.items():
        record[name] = values
    return Flight(SCENARIO, record, Outcome("complete", 60.0, ""), 1.0)


TIME = flight().record["time"]
TRUTH = flight().record["effectiveness_thrust"]


def test_errors_are_true_minus_reference_over_the_whole_flight():
    m = flight_metrics(flight(airspeed=3.0, heading=np.radians(-2.0)))
    assert m["rmse_airspeed_mps"] == pytest.approx(3.0)
    assert m["peak_error_heading_deg"] == pytest.approx(2.0)
    assert m["rmse_flight_path_deg"] == 0.0


def test_estimate_is_judged_outside_the_settling_times():
    """Wrong by 0.2 only in the first 2 s and for 2 s after the fault at 20 s: counts for nothing."""
    wrong = np.where((TIME < 2.0) | ((TIME >= 20.0) & (TIME < 22.0)), 0.2, 0.01)
    m = flight_metrics(flight(effectiveness_thrust_est=TRUTH + wrong))
    assert m["effectiveness_thrust_error_max"] == pytest.approx(0.01)
    assert m["effectiveness_thrust_error_rms"] == pytest.approx(0.01)
    assert judged(flight()).sum() == 6001 - 400


def test_detection_delay_and_false_alarms():
    declared = (TIME >= 20.4) | ((TIME >= 5.0) & (TIME < 6.0))
    m = flight_metrics(flight(effectiveness_thrust_est=TRUTH, fault_declared=declared))
    assert m["detection_delay_s"] == pytest.approx(0.4)
    assert m["false_alarms"] == 1


def test_fault_that_is_never_declared_has_no_delay():
    m = flight_metrics(flight(effectiveness_thrust_est=TRUTH))
    assert m["detection_delay_s"] is None
    assert m["false_alarms"] == 0


def test_loop_without_estimator_has_no_estimation_numbers():
    m = flight_metrics(flight())
    assert m["effectiveness_thrust_error_rms"] is None
    assert m["false_alarms"] is None


def test_saturation_counts_either_limit_once():
    m = flight_metrics(flight(thrust_saturated=TIME < 15.0, load_factor_saturated=TIME < 30.0))
    assert m["saturated_fraction"] == pytest.approx(0.5, abs=1e-3)


def test_verdict():
    assert passed(flight_metrics(flight()))
    departed = flight()._replace(outcome=Outcome("departed", 12.0, "vertical"))
    assert not passed(flight_metrics(departed))


def test_fault_declared_before_its_onset_has_no_delay_and_is_a_false_alarm():
    """A standing false alarm is not a detection in no time."""
    m = flight_metrics(flight(effectiveness_thrust_est=TRUTH, fault_declared=TIME >= 12.0))
    assert m["detection_delay_s"] is None
    assert m["false_alarms"] == 1


def test_unknown_numbers_are_none_and_the_document_is_json():
    """A loop that tells nothing of limits, and a flight of a single row."""
    unknown = flight(thrust_saturated=np.nan, load_factor_saturated=np.nan, outside_range=np.nan)
    m = flight_metrics(unknown)
    assert m["saturated_fraction"] is None
    assert m["outside_identified_fraction"] is None
    assert m["unobservable_fraction"] == {"thrust": None}
    short = unknown._replace(record=unknown.record[:1])
    json.dumps(flight_metrics(short), allow_nan=False)


def test_channel_that_nothing_excites_is_not_observable_and_its_estimate_holds():
    """Bank lost to 0.85 at 2 s in straight flight: unseen until the first turn at 5 s, then estimated.

    Wings level the estimate stays at 1 within 0.02 while its variance grows with Q; in the turn it is
    within 0.02 of the truth 3 s on.
    """
    scenario = load_scenario(
        "paper",
        [
            "loop.estimator.channels=['thrust','bank_angle']",
            "loop.estimator.process_noise=[1e-10,1e-10,1e-10,1e-8,1e-8]",
            "loop.estimator.measurement_noise=[1e-10,1e-10,1e-10]",
            "loop.estimator.initial_covariance=[1e-6,1e-8,1e-6,1e-4,1e-4]",
            "fault=[{target='bank_angle',effectiveness=0.85,start=2}]",
            "duration=12",
        ],
    )
    flown = fly(scenario)
    hidden, time = unobservable(flown, "bank_angle"), flown.record["time"]
    assert hidden[(time > 1.0) & (time < 5.0)].all()
    assert not hidden[(time > 6.5) & (time < 9.0)].any()
    assert not unobservable(flown, "thrust")[time > 1.0].any()
    estimate = flown.record["effectiveness_bank_angle_est"]
    assert np.abs(estimate[time < 5.0] - 1.0).max() < 0.02
    assert np.abs(estimate[(time > 8.0) & (time < 10.0)] - 0.85).max() < 0.02
