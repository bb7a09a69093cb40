"""The main job in numbers, repeatability, departure and interruption."""

import numpy as np
import pytest

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.analysis.verdict import passed
from ftc_jsb.errors import ScenarioError
from ftc_jsb.recording.columns import ROW
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly

JSBSIM = "model=jsbsim"


def test_paper_is_reproduced(flown):
    """The sizes that an independent prototype of the paper's section 5 gave, and their margins.

    Estimate within 0.01 of 0.6 no later than 1 s after the fault; RMSE of V at most 0.05 m/s with
    FTC, 1.9 m/s (+- 0.1) without; bank 77 deg, load factor 3.44, thrust command 107 kN at most.
    """
    record = flown("paper").record
    late = record["time"] >= 21.0
    assert np.abs(record["effectiveness_thrust_est"][late] - 0.6).max() <= 0.01
    metrics = flight_metrics(flown("paper"))
    assert metrics["rmse_airspeed_mps"] <= 0.05
    assert flight_metrics(flown("paper", "loop.name=no-ftc"))["rmse_airspeed_mps"] == pytest.approx(
        1.9, abs=0.1
    )
    assert metrics["peak_bank_deg"] == pytest.approx(77.0, abs=0.5)
    assert metrics["peak_load_factor"] == pytest.approx(3.44, abs=0.01)
    assert record["thrust_cmd"][:-1].max() == pytest.approx(107e3, abs=1e3)


def test_jsbsim_f16_meets_its_targets(flown):
    """The paper's scenario on the corrected F-16 in clean air.

    Targets: |k error| <= 0.03 for 95 % and <= 0.05 for all judged samples; RMSE V <= 0.4 m/s, path
    <= 0.06 deg, heading <= 0.16 deg; RMSE V without FTC at least 6 times; sideslip <= 1.5 deg; no limit.
    """
    metrics = flight_metrics(flown("paper", JSBSIM))
    assert passed(metrics)
    assert metrics["effectiveness_thrust_error_p95"] <= 0.03
    assert metrics["effectiveness_thrust_error_max"] <= 0.05
    assert metrics["rmse_airspeed_mps"] <= 0.4
    assert metrics["rmse_flight_path_deg"] <= 0.06
    assert metrics["rmse_heading_deg"] <= 0.16
    assert metrics["peak_sideslip_deg"] <= 1.5
    without = flight_metrics(flown("paper", JSBSIM, "loop.name=no-ftc"))
    assert without["rmse_airspeed_mps"] >= 6.0 * metrics["rmse_airspeed_mps"]


def test_identified_point_mass_tells_what_the_aircraft_does(flown):
    """Same loop on both: RMS difference of V <= 0.3 m/s, path <= 0.05 deg, heading <= 0.15 deg, 25 m."""
    one, other = flown("paper", "model=identified").record, flown("paper", JSBSIM).record

    def rms(name):
        return np.sqrt(np.mean((one[name] - other[name]) ** 2))

    assert rms("airspeed") <= 0.3
    assert np.degrees(rms("flight_path_angle")) <= 0.05
    assert np.degrees(rms("heading")) <= 0.15
    apart = [one[axis][-1] - other[axis][-1] for axis in ("north", "east", "altitude")]
    assert np.linalg.norm(apart) <= 25.0


def test_stock_flight_control_flies_and_shows_what_the_corrections_are_for(flown):
    """Uncorrected, the F-16 slips more than 2 deg in the same turns; the estimate still holds."""
    stock = flight_metrics(flown("paper", JSBSIM, "aircraft.flight_control=stock"))
    corrected = flight_metrics(flown("paper", JSBSIM))
    assert stock["peak_sideslip_deg"] > 2.0 > corrected["peak_sideslip_deg"]
    assert stock["effectiveness_thrust_error_p95"] <= 0.03


@pytest.mark.parametrize("model", ["paper", "identified", "jsbsim"])
def test_healthy_flight_raises_no_alarm(flown, model):
    metrics = flight_metrics(flown("nominal", f"model={model}"))
    assert passed(metrics)
    assert metrics["false_alarms"] == 0
    assert metrics["detection_delay_s"] is None
    assert metrics["effectiveness_thrust_error_max"] <= 0.01


@pytest.mark.parametrize("model", ["paper", "jsbsim"])
def test_severe_loss_saturates_thrust_and_keeps_the_path(flown, model):
    """0.4 from 7 s: at the limit for 40 % of the time and more, airspeed falls, path and heading hold."""
    metrics = flight_metrics(flown("severe", f"model={model}"))
    assert passed(metrics)
    assert metrics["saturated_fraction"] > 0.4
    assert metrics["rmse_airspeed_mps"] > 2.0
    assert metrics["rmse_flight_path_deg"] < 0.1
    assert metrics["rmse_heading_deg"] < 0.2
    late = flown("severe", f"model={model}").record["time"] > 9.0
    estimate = flown("severe", f"model={model}").record["effectiveness_thrust_est"][late]
    assert np.abs(estimate - 0.4).max() < 0.01


@pytest.mark.parametrize("model", ["paper", "jsbsim"])
def test_ramp_is_followed_with_a_small_lag(flown, model):
    """1 to 0.5 over 10 s: never off by more than 0.03, and exact again 1 s after its end."""
    record = flown("ramp", f"model={model}").record
    error = np.abs(record["effectiveness_thrust_est"] - record["effectiveness_thrust"])
    assert error[record["time"] > 2.0].max() < 0.03
    assert error[record["time"] > 26.0].max() < 0.01


@pytest.mark.parametrize("model", ["paper", "jsbsim"])
def test_every_intermittent_loss_is_declared_and_withdrawn(flown, model):
    """Five losses, five declarations within 1 s each; between them healthy within 1 s of recovery."""
    record = flown("intermittent", f"model={model}").record
    declared = record["fault_declared"] > 0.5
    time = record["time"]
    for start in (10.0, 20.0, 30.0, 40.0, 50.0):
        assert declared[(time >= start + 1.0) & (time < start + 5.0)].all()
        assert not declared[(time >= start + 6.5) & (time < start + 10.0)].any()
    assert flight_metrics(flown("intermittent", f"model={model}"))["false_alarms"] == 0


@pytest.mark.parametrize("model", ["paper", "identified", "jsbsim"])
def test_total_loss_divides_by_nothing(flown, model):
    """Effectiveness 0 at 20 s: all finite, thrust at its maximum, path and heading still tracked.

    The airspeed is lost all the same, by more than 45 m/s, and the verdict says so.
    """
    flight = flown("total-loss", f"model={model}")
    assert flight.outcome.status == "complete"
    assert flight_metrics(flight)["verdict"] == "loss of control"
    for name in ("thrust_cmd", "load_factor_cmd", "bank_angle_cmd", "effectiveness_thrust_est"):
        assert np.isfinite(flight.record[name]).all()
    late = flight.record["time"] > 22.0
    assert np.abs(flight.record["effectiveness_thrust_est"][late]).max() < 0.01
    assert (flight.record["thrust_saturated"][late] == 1.0).all()
    assert flight_metrics(flight)["rmse_heading_deg"] < 0.2


@pytest.mark.parametrize("model", ["paper", "identified", "jsbsim"])
def test_same_scenario_twice_is_bit_identical(flown, model):
    scenario = load_scenario("paper", [f"model={model}", "duration=25"])
    one, other = fly(scenario).record, fly(scenario).record
    for name in ROW.names:
        np.testing.assert_array_equal(one[name], other[name], err_msg=name)


def test_flight_that_departs_ends_with_time_and_reason():
    """A loop that pushes -3 g until it flies straight down; the recording ends there, finite before."""
    name = "loop.name='tests.control.my_loop:ExplodingLoop'"
    for model in ("paper", "jsbsim"):
        flight = fly(load_scenario("nominal", [name, f"model={model}"]))
        assert flight.outcome.status == "departed"
        assert 1.0 < flight.outcome.time < 30.0
        assert flight.outcome.reason
        assert flight.record["time"][-1] == pytest.approx(flight.outcome.time)
        assert not passed(flight_metrics(flight))


def test_interruption_keeps_what_was_flown():
    """Ctrl-C after row 1234 is complete: it and the 1234 before it, and the status says so."""

    def interrupt(record, i):
        if i == 1234:
            raise KeyboardInterrupt

    flight = fly(load_scenario("paper"), observers=[interrupt])
    assert flight.outcome.status == "interrupted"
    assert flight.record.size == 1235
    whole = fly(load_scenario("paper")).record
    np.testing.assert_array_equal(flight.record["airspeed"], whole["airspeed"][:1235])


def test_observers_change_nothing(flown):
    seen = []
    record = fly(load_scenario("paper"), observers=[lambda record, i: seen.append(i)]).record
    assert seen == list(range(6001))
    np.testing.assert_array_equal(record["airspeed"], flown("paper").record["airspeed"])


def test_rate_and_substeps_change_the_paper_result_little(flown):
    """50 and 200 Hz instead of 100: RMSE of V with FTC within 0.01 m/s of it."""
    base = flight_metrics(flown("paper"))["rmse_airspeed_mps"]
    for rate in (50, 200):
        other = flight_metrics(flown("paper", f"loop.rate={rate}"))["rmse_airspeed_mps"]
        assert other == pytest.approx(base, abs=0.01)


@pytest.mark.parametrize("model", ["paper", "identified"])
def test_three_channels_at_once_are_estimated(flown, model):
    """Losses of thrust, load factor and bank 0.7, 0.8, 0.85 at 6 s, in the first turn: 0.02 at 9 s.

    On the identified aircraft the inner loop lags: the filter is given the lagged command.

    With variances of 1e-10 for states and measurements and 1e-8 for the factors; the printed R of
    the heading is too large to tell the bank from it.
    """
    estimator = (
        "loop.estimator.channels=['thrust','load_factor','bank_angle']",
        "loop.estimator.process_noise=[1e-10,1e-10,1e-10,1e-8,1e-8,1e-8]",
        "loop.estimator.measurement_noise=[1e-10,1e-10,1e-10]",
        "loop.estimator.initial_covariance=[1e-6,1e-8,1e-6,1e-4,1e-4,1e-4]",
    )
    faults = (
        "fault=[{effectiveness=0.7,start=6},{target='load_factor',effectiveness=0.8,start=6},"
        "{target='bank_angle',effectiveness=0.85,start=6}]"
    )
    flight = flown("paper", f"model={model}", *estimator, faults)
    row = flight.record[900]
    for channel, truth in (("thrust", 0.7), ("load_factor", 0.8), ("bank_angle", 0.85)):
        assert row[f"effectiveness_{channel}"] == pytest.approx(truth)
        assert row[f"effectiveness_{channel}_est"] == pytest.approx(truth, abs=0.02)
    assert flight.outcome.status == "complete"


def test_fault_that_the_model_cannot_have_is_refused():
    """The point mass has a bank channel to lose, the JSBSim aircraft has not."""
    lost = "fault=[{target='bank_angle',effectiveness=0.8,start=6}]"
    assert fly(load_scenario("paper", [lost, "duration=1"])).outcome.status == "complete"
    with pytest.raises(ScenarioError, match="'bank_angle' is a channel of the point masses"):
        fly(load_scenario("paper", [lost, JSBSIM]))


@pytest.mark.parametrize(("model", "most"), [("paper", 2.0), ("identified", 2.0), ("jsbsim", 20.0)])
def test_path_loop_tracks_a_climbing_helix_through_a_loss_of_thrust(flown, model, most):
    """RMS distance from the path: 2 m on the point masses, 20 m on the F-16, over all 120 s."""
    metrics = flight_metrics(flown("helix", f"model={model}"))
    assert passed(metrics)
    assert metrics["rmse_position_m"] <= most
    velocity_loop = flight_metrics(flown("helix", f"model={model}", "loop.name=ftc"))
    assert metrics["rmse_position_m"] < 0.5 * velocity_loop["rmse_position_m"]


def test_flight_outside_the_identified_range_says_so(flown):
    """A push to -1.5 g and a climb past the tested altitudes; the paper's aircraft has no range."""
    inside = flight_metrics(flown("paper", JSBSIM))
    assert inside["outside_identified_fraction"] == 0.0
    high = ("initial.altitude=11000", "initial.airspeed=270", "reference.airspeed=[[0,270]]")
    quiet = ("reference.heading_deg=[[0,0]]", "duration=5")
    outside = flight_metrics(flown("nominal", "model=identified", *high, *quiet))
    assert outside["outside_identified_fraction"] == 1.0
    paper = flight_metrics(flown("nominal", *high, *quiet))
    assert paper["outside_identified_fraction"] == 0.0
