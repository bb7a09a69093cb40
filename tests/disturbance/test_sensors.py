"""Sensors on a flight: each error and each fault is there as written, and nothing else."""

import math
from typing import Any

import numpy as np
import pytest

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.disturbance.noise import normal, uniform
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from ftc_jsb.vocabulary.signals import SENSED, SIGNALS

MODEL = "model=identified"


def flown(*overrides: str) -> Any:
    return fly(load_scenario("nominal", [MODEL, "duration=30", *overrides])).record


def fault(text: str) -> str:
    return f"fault=[{{{text}}}]"


def test_noise_is_normal_and_white():
    """Mean, variance, fourth moment and the correlation of neighbours over 1e5 draws: 4 sigma."""
    draws = np.array([normal(7, 3, i) for i in range(100_000)])
    assert abs(draws.mean()) < 4 / math.sqrt(1e5)
    assert draws.var() == pytest.approx(1.0, abs=4 * math.sqrt(2 / 1e5))
    assert np.mean(draws**4) == pytest.approx(3.0, abs=4 * math.sqrt(96 / 1e5))
    assert abs(np.mean(draws[1:] * draws[:-1])) < 4 / math.sqrt(1e5)
    assert abs(np.mean([normal(7, 4, i) * draws[i] for i in range(10_000)])) < 0.04


def test_uniform_numbers_never_touch_the_ends():
    values = [uniform(0, 0, i) for i in range(10_000)]
    assert 0.0 < min(values) < max(values) < 1.0


def test_perfect_sensors_tell_the_truth():
    record = flown()
    for signal in SIGNALS:
        name = signal.column or signal.name
        np.testing.assert_array_equal(record[f"{name}_meas"], record[name])
    np.testing.assert_array_equal(record["heading_meas"], record["heading"])


def test_noise_has_the_size_that_was_asked_for():
    """Standard deviation within 6 % of 0.5 m/s and 0.2 deg over 3000 samples (4 sigma)."""
    record = flown("sensors.airspeed.noise=0.5", "sensors.pitch.noise_deg=0.2")
    error = record["airspeed_meas"] - record["airspeed"]
    assert error.std() == pytest.approx(0.5, rel=0.06)
    assert np.degrees(record["pitch_meas"] - record["pitch"]).std() == pytest.approx(0.2, rel=0.06)
    path = record["flight_path_angle_meas"] - record["flight_path_angle"]
    assert np.degrees(path).std() == pytest.approx(0.2, rel=0.08)  # in straight and banked flight
    np.testing.assert_array_equal(record["alpha_meas"], record["alpha"])


def test_slow_sensor_holds_its_reading():
    """20 Hz at 100 Hz: five samples the same, each the truth of the first."""
    record = flown("sensors.altitude.rate=20")
    for i in range(0, 3000, 5):
        assert np.all(record["altitude_meas"][i : i + 5] == record["altitude"][i])


def test_late_sensor_tells_what_was():
    """0.05 s late is five samples, 0.025 s lies half way between the second and the third."""
    record = flown("sensors.airspeed.delay=0.05", "sensors.altitude.delay=0.025")
    np.testing.assert_allclose(
        record["airspeed_meas"][5:], record["airspeed"][:-5], rtol=0.0, atol=1e-6
    )
    between = 0.5 * (record["altitude"][:-3] + record["altitude"][1:-2])
    np.testing.assert_allclose(record["altitude_meas"][3:], between, rtol=0.0, atol=1e-6)


def test_bias_spread_is_drawn_once_a_flight_from_the_seed():
    errors = []
    for seed in range(8):
        record = flown("duration=1", "sensors.airspeed.bias_spread=1.0", f"seed={seed}")
        error = record["airspeed_meas"] - record["airspeed"]
        assert np.ptp(error) < 1e-9
        errors.append(error[0])
    assert 0.3 < np.std(errors) < 2.0
    again = flown("duration=1", "sensors.airspeed.bias_spread=1.0", "seed=3")
    assert again["airspeed_meas"][0] - again["airspeed"][0] == errors[3]


def test_flights_with_one_seed_are_the_same_and_with_another_are_not():
    tactical = "sensors.profile=tactical"
    one, same, other = flown(tactical), flown(tactical), flown(tactical, "seed=1")
    np.testing.assert_array_equal(one["airspeed_meas"], same["airspeed_meas"])
    assert not np.any(one["airspeed_meas"] == other["airspeed_meas"])


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('target="airspeed", kind="bias", size=2.0, start=10.0, end=20.0', lambda t: 2.0),
        (
            'target="airspeed", kind="drift", size=0.1, start=10.0, end=20.0',
            lambda t: 0.1 * (t - 10),
        ),
        (
            'target="airspeed", kind="bias", size=2.0, start=10.0, end=20.0, shape="ramp", rise=5.0',
            lambda t: np.minimum(2.0 * (t - 10) / 5, 2.0),
        ),
    ],
)
def test_offset_faults(text, expected):
    record = flown(fault(text))
    time, error = record["time"], record["airspeed_meas"] - record["airspeed"]
    acting = (time >= 10.0) & (time < 20.0)
    np.testing.assert_allclose(
        error[acting], np.broadcast_to(expected(time[acting]), acting.sum()), atol=1e-6
    )
    assert np.all(error[~acting] == 0.0)


def test_angles_of_sensor_faults_are_in_degrees():
    record = flown(fault('target="yaw", kind="bias", size_deg=3.0, start=10.0'))
    error = np.degrees(record["yaw_meas"] - record["yaw"])
    np.testing.assert_allclose(error[1000:], 3.0, atol=1e-9)


def test_frozen_sensor_stays_where_it_was():
    record = flown(fault('target="altitude", kind="freeze", start=10.0, end=20.0'))
    held = record["altitude_meas"][1000:2000]
    assert np.all(held == record["altitude_meas"][999])
    assert record["altitude_meas"][2000] == record["altitude"][2000]


@pytest.mark.parametrize("model", ["identified", "jsbsim"])
@pytest.mark.parametrize(
    "target", ["airspeed", "alpha", "pitch", "altitude", "load_factor_z", "north"]
)
@pytest.mark.parametrize("loop", ["ftc", "integral", "robust", "path"])
def test_silent_sensor_does_not_bring_the_loop_down(model, target, loop):
    """Two seconds without a signal, in the turn: every command finite, the flight inside its limits.

    The loops fly on by what their filter predicts, or by what was last seen.
    """
    text = f'target="{target}", kind="dropout", start=12.0, end=14.0'
    flight = fly(
        load_scenario("paper", [f"model={model}", "duration=20", f"loop.name={loop}", fault(text)])
    )
    silent = flight.record[f"{target}_meas"]
    assert np.isfinite(silent[1400:]).all()
    if np.isfinite(
        flight.record["suspect"]
    ).all():  # isolated: 0.1 s later something stands in for it
        assert np.isnan(silent[1200:1205]).all()
        assert (flight.record["excluded"][1215:1400] == 1 << SENSED.index(target)).all()
    else:
        assert np.isnan(silent[1200:1400]).all()
    for name in ("thrust_cmd", "load_factor_cmd", "bank_angle_cmd"):
        assert np.isfinite(flight.record[name]).all()
    assert flight_metrics(flight)["status"] == "complete"


@pytest.mark.parametrize("target", ["airspeed", "altitude"])
def test_sensor_that_is_silent_from_the_start_is_begun_without(target):
    """The loop begins at its reference, which starts at the initial condition, and flies on."""
    text = f'target="{target}", kind="dropout", start=0.0, end=2.0'
    flight = fly(load_scenario("nominal", [MODEL, "duration=5", fault(text)]))
    assert flight_metrics(flight)["status"] == "complete"
    assert flight_metrics(flight)["peak_error_airspeed_mps"] < 1.0
