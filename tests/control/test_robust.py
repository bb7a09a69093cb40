"""The robust loop: covariances from the instruments, the accelerometer, turbulence."""

import math

import numpy as np
import pytest

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.disturbance.sensor_profiles import PROFILES, Errors
from ftc_jsb.loops.tuning import covariances
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from ftc_jsb.vocabulary.signals import SENSED

DISTURBED = ("sensors.profile=tactical", "wind.turbulence=moderate", "loop.name=robust")


def errors(**changed: Errors) -> dict[str, Errors]:
    return {name: Errors() for name in SENSED} | changed


def test_measurement_noise_is_that_of_the_instruments():
    """Airspeed 0.3 m/s read at 50 Hz counts twice at 100 Hz; angles add their squares."""
    suite = errors(
        airspeed=Errors(noise=0.3, rate=50.0),
        pitch=Errors(noise=0.03),
        alpha=Errors(noise=0.04),
        load_factor_x=Errors(noise=0.01),
    )
    r = covariances(suite, 0.01)
    assert r.measurement[0] == pytest.approx(2 * 0.3**2)
    assert r.measurement[1] == pytest.approx(math.radians(0.05) ** 2)
    assert r.acceleration == pytest.approx(9.80665**2 * 0.01**2)
    assert r.angles == pytest.approx((math.radians(0.04) ** 2, 0.0, 0.0, 0.0))


@pytest.mark.parametrize(("scenario", "most"), [("paper", 0.03), ("f15", 0.4), ("t38", 0.05)])
def test_deviation_is_a_confidence_whatever_the_instruments_are_off_by(scenario, most):
    """Six flights, each with biases of its own: truth inside 2 sigma 90 % of the time, sigma below `most`.

    Biases are the same for a whole flight, so that one flight may lie outside; the F-15's drag turns 0.1 deg
    of sideslip vane into 0.15 of its thrust.
    """
    inside, deviations = [], []
    for seed in range(11, 17):
        record = fly(
            load_scenario(scenario, ["model=jsbsim", f"seed={seed}", "duration=40", *DISTURBED])
        ).record
        use = (record["time"] > 5.0) & ((record["time"] < 20.0) | (record["time"] > 22.0))
        error = record["effectiveness_thrust_est"] - record["effectiveness_thrust"]
        deviation = record["effectiveness_thrust_std"]
        inside.append(np.mean(np.abs(error[use]) < 2.0 * deviation[use]))
        deviations.append(np.mean(deviation[use]))
    assert np.mean(inside) > 0.9
    assert np.mean(deviations) < most


def test_point_mass_without_measured_drag_considers_its_instruments_too():
    """The polar's drag: airspeed and alpha are off by something there, too; sigma is not the filter's alone."""
    scenario = ["model=identified", "duration=15", "fault=[]", *DISTURBED]
    real = fly(load_scenario("paper", scenario)).record["effectiveness_thrust_std"][-1]
    unbiased = [
        *scenario,
        *(f"sensors.{name}.bias_spread=0" for name in ("airspeed", "load_factor_x")),
        "sensors.alpha.bias_spread_deg=0",
    ]
    ideal = fly(load_scenario("paper", unbiased)).record["effectiveness_thrust_std"][-1]
    assert real > 1.1 * ideal


def test_perfect_sensors_leave_a_filter_that_can_be_inverted():
    r = covariances(errors(), 0.01)
    assert min(r.measurement) > 0.0
    assert r.acceleration > 0.0


def test_noisier_sensors_mean_larger_r_and_the_same_q():
    fine, coarse = (
        covariances(PROFILES["tactical"], 0.01),
        covariances(
            {k: v._replace(noise=3 * v.noise) for k, v in PROFILES["tactical"].items()}, 0.01
        ),
    )
    assert all(
        b == pytest.approx(9 * a) for a, b in zip(fine.measurement, coarse.measurement, strict=True)
    )
    assert fine.process == coarse.process


@pytest.mark.parametrize("model", ["identified", "jsbsim"])
@pytest.mark.parametrize("seed", [3, 4])
def test_estimate_is_useful_through_sensors_and_turbulence(model, seed):
    """Within 0.04 for 95 % of the time, found within 1.5 s, no false alarm: what is asked of it.

    `make validate` flies twenty seeds and ten minutes each without a fault.
    """
    flight = fly(load_scenario("paper", [f"model={model}", f"seed={seed}", *DISTURBED]))
    metrics = flight_metrics(flight)
    assert metrics["effectiveness_thrust_error_p95"] < 0.04
    assert metrics["detection_delay_s"] < 1.5
    assert metrics["false_alarms"] == 0
    assert metrics["peak_error_flight_path_deg"] < 3.0


def test_accelerometer_is_what_makes_the_difference():
    """The same tuning without it: the gusts of the airspeed are taken for changes of thrust."""
    common = (
        "model=jsbsim",
        *DISTURBED[:2],
        "loop.estimator.tuning=sensors",
        "loop.feedback=estimated",
    )
    deaf = flight_metrics(fly(load_scenario("paper", list(common))))
    feeling = flight_metrics(
        fly(load_scenario("paper", [*common, "loop.estimator.accelerometer=true"]))
    )
    assert feeling["effectiveness_thrust_error_p95"] < 0.2 * deaf["effectiveness_thrust_error_p95"]


def test_robust_loop_is_the_papers_equal_in_calm_air():
    """Perfect sensors, no wind: estimate within 0.01 and airspeed as good as with the printed Q, R."""
    record = fly(load_scenario("paper", ["model=jsbsim", "loop.name=robust"])).record
    late = (record["time"] > 2.0) & ~((record["time"] >= 20.0) & (record["time"] < 23.0))
    error = record["effectiveness_thrust_est"] - record["effectiveness_thrust"]
    assert np.abs(error[late]).max() < 0.01


@pytest.mark.parametrize("time", [0.3, 2.0])
def test_estimate_follows_a_loss_in_the_response_time(time):
    """Half a loss of 0.4 is found after 0.5 to 1.5 response times' ln 2."""
    record = fly(
        load_scenario(
            "nominal",
            [
                "model=identified", "loop.name=robust", f"loop.estimator.response_time={time}",
                "sensors.profile=tactical", "fault=[{effectiveness=0.6, start=20.0}]",
            ],
        )
    ).record  # fmt: skip
    half = record["time"][np.flatnonzero(record["effectiveness_thrust_est"] < 0.8)[0]] - 20.0
    assert 0.5 * math.log(2.0) * time < half < 1.5 * math.log(2.0) * time + 0.05


CHANNELS = (
    "model=identified", 'loop.estimator.channels=["thrust","load_factor","bank_angle"]',
    "loop.estimator.process_noise=[1e-10,1e-10,1e-3,1e-10,1e-8,1e-8]",
    "loop.estimator.initial_covariance=[1e-6,1e-8,1e-6,1e-4,1e-4,1e-4]",
)  # fmt: skip


@pytest.mark.parametrize("channel", ["load_factor", "bank_angle"])
def test_losses_of_load_factor_and_bank_are_followed_in_turbulence(channel):
    """0.7 of either, tactical sensors, moderate turbulence: RMS error from 5 s after on below 0.05, which is
    2 to 4 times what was measured over six seeds; with the thrust's Q it was 0.07 and 0.11. Thrust: 0.02.
    """
    fault = f'fault=[{{target="{channel}", effectiveness=0.7, start=20.0}}]'
    record = fly(load_scenario("turbulence", [*CHANNELS, fault, "seed=1"])).record
    late = record["time"] > 25.0
    for name, most in ((channel, 0.05), ("thrust", 0.02)):
        error = record[f"effectiveness_{name}_est"] - record[f"effectiveness_{name}"]
        assert np.sqrt(np.mean(error[late] ** 2)) < most
