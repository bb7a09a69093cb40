"""Physical faults on the woven F-16: what is said happens to engine and surfaces, and ends."""

import json
from typing import Any

import numpy as np
import pytest

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.errors import ScenarioError
from ftc_jsb.runs.check import check_scenario
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly


def override(**keys: Any) -> str:
    return "fault=[{" + ", ".join(f"{k} = {json.dumps(v)}" for k, v in keys.items()) + "}]"


def flown(*overrides: str, **keys: Any) -> Any:
    settings = ["model=jsbsim", "duration=30", override(**keys), *overrides]
    return fly(load_scenario("paper", settings))


def test_loss_of_the_only_engine_is_the_loss_of_thrust():
    one = flown(target="engine[0]", effectiveness=0.6, start=20.0).record
    other = flown(target="thrust", effectiveness=0.6, start=20.0).record
    np.testing.assert_array_equal(one["airspeed"], other["airspeed"])
    assert one["engine_0_effectiveness"][-1] == 0.6


def test_flame_out_leaves_no_thrust():
    """None from the next sample on, and the filter finds it: effectiveness 0 within 0.02 after 2 s."""
    record = flown(target="engine[0]", kind="flame-out", start=10.0, end=15.0).record
    out = (record["time"] > 10.02) & (record["time"] <= 15.0)
    assert np.abs(record["thrust"][out]).max() < 100.0
    assert np.all(record["effectiveness_thrust"][out & (record["time"] < 15.0)] == 0.0)
    assert np.abs(record["effectiveness_thrust_est"][1200:1500]).max() < 0.02
    assert record["thrust"][1800] == pytest.approx(record["thrust_cmd"][1800], rel=0.03)


def test_engine_that_is_lit_again_spools_up_from_idle():
    """Out for 0.6 s: less than half of the command 0.4 s later, all of it after 4 s."""
    record = flown(
        "loop.name=no-ftc", target="engine[0]", kind="flame-out", start=4.0, end=4.6
    ).record
    assert record["thrust"][500] < 0.5 * record["thrust_cmd"][500]
    assert record["thrust"][860] == pytest.approx(record["thrust_cmd"][860], rel=0.03)


def test_stuck_throttle_stays_and_its_effectiveness_is_not_told():
    """The throttle holds to 1e-12 while the command moves; afterwards it follows again."""
    record = flown(target="engine[0]", kind="stuck", start=8.0, end=16.0).record
    assert np.ptp(record["throttle"][802:1600]) < 1e-12
    assert np.ptp(record["thrust_cmd"][802:1600]) > 1e3
    assert np.isnan(record["effectiveness_thrust"][800:1600]).all()
    assert np.isfinite(record["effectiveness_thrust"][1600:]).all()
    assert np.ptp(record["throttle"][1602:]) > 0.1


@pytest.mark.parametrize("surface", ["elevator", "aileron", "rudder"])
def test_stuck_surface_stays_where_it_was(surface):
    record = flown(target=surface, kind="stuck", start=12.0, end=12.5).record
    assert np.ptp(record[surface][1202:1250]) < 1e-12
    assert np.ptp(record[surface][1252:1400]) > 1e-4


@pytest.mark.parametrize("direction", [-1, 1])
@pytest.mark.parametrize(
    ("surface", "end"), [("elevator", 0.436), ("aileron", 0.375), ("rudder", 0.524)]
)
def test_hard_over_surface_runs_to_its_stop(surface, end, direction):
    """From one end to the other in half a second: at the stop after 0.3 s, not after 0.1 s."""
    flight = flown(
        "duration=12.6", target=surface, kind="hard-over", direction=direction, start=12.0
    )
    position = flight.record[surface]
    assert position[1230] == pytest.approx(direction * end, abs=1e-9)
    assert abs(position[1210]) < end


@pytest.mark.parametrize("surface", ["elevator", "aileron", "rudder"])
def test_half_a_surface_is_made_up_for_by_the_inner_loop(surface):
    """The incremental inversion asks for twice the travel: the flight stays inside its limits."""
    flight = flown(target=surface, effectiveness=0.5, start=4.0)
    metrics = flight_metrics(flight)
    assert metrics["limits_broken"] == []
    assert metrics["rmse_airspeed_mps"] < 0.1
    assert metrics["false_alarms"] == 0


def test_weaving_of_faults_changes_nothing_in_healthy_flight():
    """A fault that begins after the end of the flight leaves no trace."""
    healthy = fly(load_scenario("paper", ["model=jsbsim", "duration=15", "fault=[]"])).record
    later = flown("duration=15", target="elevator", kind="stuck", start=40.0).record
    np.testing.assert_array_equal(healthy["airspeed"], later["airspeed"])


@pytest.mark.parametrize(
    ("model", "keys", "says"),
    [
        (
            "jsbsim",
            {"target": "engine[1]", "kind": "flame-out"},
            "no 'engine[1]'; aircraft 'f16' has 1",
        ),
        ("jsbsim", {"target": "bank_angle", "effectiveness": 0.5}, "a channel of the point masses"),
        (
            "identified",
            {"target": "elevator", "kind": "stuck"},
            "the model 'identified' has no 'elevator'",
        ),
        ("paper", {"target": "engine[0]", "kind": "stuck"}, "a stuck throttle"),
        ("identified", {"target": "roll_rate", "kind": "freeze"}, "has no 'roll_rate'"),
    ],
)
def test_fault_that_the_model_cannot_have_is_refused_before_flight(model, keys, says):
    scenario = load_scenario("paper", [f"model={model}", override(start=10.0, **keys)])
    with pytest.raises(ScenarioError, match=r"fault\[0\]\.target") as refusal:
        check_scenario(
            scenario.model_copy(
                update={"compare": scenario.compare.model_copy(update={"models": (model,)})}
            )
        )
    assert says in str(refusal.value)


@pytest.mark.parametrize(
    ("keys", "says"),
    [
        ({"target": "elevator", "kind": "flame-out"}, "'elevator' cannot have 'flame-out'"),
        ({"target": "wing", "effectiveness": 0.5}, "no 'wing'; expected a channel"),
        ({"target": "airspeed", "kind": "bias"}, "needs the key 'size'"),
        ({"target": "alpha", "kind": "bias", "size": 1.0}, "does not take the key 'size'"),
        ({"target": "rudder", "kind": "hard-over"}, "needs the key 'direction'"),
        (
            {"target": "engine[0]", "kind": "stuck", "shape": "ramp", "rise": 2.0},
            "cannot be a ramp",
        ),
    ],
)
def test_fault_that_makes_no_sense_is_refused_with_what_was_expected(keys, says):
    with pytest.raises(ScenarioError) as refusal:
        load_scenario("paper", [override(start=10.0, **keys)])
    assert says in str(refusal.value)


def test_one_of_two_engines_lost_is_half_the_thrust_and_a_yaw_that_is_held():
    """F-15, right engine out at 20 s: 0.5 within 0.05, found within 1.5 s, inside every limit.

    The rudder holds the moment of the other engine: it moves, sideslip stays within 0.5 deg.
    """
    flight = fly(load_scenario("engine-out"))
    metrics, record = flight_metrics(flight), flight.record
    assert metrics["limits_broken"] == []
    assert metrics["detection_delay_s"] < 1.5
    late = record["time"] > 23.0
    assert np.abs(record["effectiveness_thrust_est"][late] - 0.5).max() < 0.05
    assert np.all(record["engine_1_state"][late] == 1.0)
    assert abs(record["rudder"][-1] - record["rudder"][1900]) > 1e-3
    assert metrics["peak_sideslip_deg"] < 0.5


@pytest.mark.parametrize("scenario", ["f15", "f4n", "a4", "t38"])
def test_every_fighter_meets_its_targets(scenario):
    """Its own manoeuvre, 1 to 0.6 at 20 s: what docs/validation.md reports, but where it says why not.

    |estimate - truth| within 0.01 (95 %) and 0.03, airspeed within 0.4 m/s RMS and six times better
    than without, path within 0.06 deg and heading within 0.15 deg, which the F-15's roll rate denies it.
    """
    metrics = flight_metrics(fly(load_scenario(scenario)))
    without = flight_metrics(fly(load_scenario(scenario, ["loop.name=no-ftc"])))
    assert metrics["limits_broken"] == []
    assert metrics["effectiveness_thrust_error_p95"] <= 0.01
    assert metrics["effectiveness_thrust_error_max"] <= 0.03
    assert metrics["rmse_airspeed_mps"] <= 0.4
    assert without["rmse_airspeed_mps"] >= 6.0 * metrics["rmse_airspeed_mps"]
    path, heading = (0.15, 0.2) if scenario == "f15" else (0.06, 0.15)
    assert metrics["rmse_flight_path_deg"] <= path
    assert metrics["rmse_heading_deg"] <= heading


@pytest.mark.parametrize("name", ["f15", "F4N", "A4", "T38"])
@pytest.mark.parametrize("surface", ["elevator", "aileron", "rudder"])
def test_surface_of_every_fighter_can_be_stuck(name, surface):
    """Held for half a second and freed: it does not move meanwhile, and the flight goes on."""
    stuck = override(target=surface, kind="stuck", start=2.0, end=2.5)
    settings = [
        "model=jsbsim",
        f"aircraft.name={name}",
        "initial.airspeed=220",
        "duration=4",
        stuck,
    ]
    settings += ["reference.airspeed=[[0,220]]", "reference.heading_deg=[[0,0],[1,0],[4,10]]"]
    flight = fly(load_scenario("paper", settings))
    position = flight.record[surface]
    assert flight.outcome.status == "complete"
    assert np.ptp(position[202:250]) < 1e-12
    assert np.ptp(position[:200]) > 1e-6
