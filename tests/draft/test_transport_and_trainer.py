"""The shipped 737 and T-37, as drafted, designed and identified: inner loop, and a loss of thrust."""

import numpy as np
import pytest

from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.analysis.verdict import passed
from ftc_jsb.inner_loop_design.criteria import criteria_missed
from ftc_jsb.inner_loop_design.handling import CLASSES, class_of
from ftc_jsb.inner_loop_design.published_steps import fly_steps
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly


@pytest.mark.parametrize(("name", "kind"), [("737", "III"), ("T37", "I")])
def test_steps_keep_the_criteria_of_the_class(name, kind):
    """Rise, overshoot, error, settling, sideslip and thrust as docs/aircraft.md has them for the class."""
    aircraft = load_aircraft(name)
    assert class_of(aircraft) == kind
    assert class_of(aircraft.model_copy(update={"airplane_class": None})) == kind
    flown = fly_steps(aircraft)
    assert len(flown) == 2
    for steps in flown:
        assert criteria_missed(steps, CLASSES[kind]) == []


def test_the_classes_ask_for_different_things():
    """What the 737 does is not good enough for a fighter."""
    steps = fly_steps(load_aircraft("737"))[0]
    missed = criteria_missed(steps, CLASSES["IV"])
    assert [what.split(" 0.")[0] for what in missed] == ["load factor rise"]


@pytest.mark.parametrize("scenario", ["737", "t37"])
def test_loss_of_thrust_is_estimated_and_made_good(scenario):
    """Thrust to 0.6 at 20 s, on JSBSim: the estimate within 0.02 from 5 s later to the end.

    Airspeed is tracked at least three times as well as without FTC, and no limit is broken.
    """
    flight = fly(load_scenario(scenario))
    row = flight.record[:-1]
    known = row["time"] >= 25.0
    assert row["effectiveness_thrust"][known] == pytest.approx(0.6)
    error = np.abs(row["effectiveness_thrust_est"] - row["effectiveness_thrust"])[known]
    assert error.max() <= 0.02
    metrics = flight_metrics(flight)
    without = flight_metrics(fly(load_scenario(scenario, ["loop.name=no-ftc"])))
    assert passed(metrics)
    assert metrics["rmse_airspeed_mps"] < without["rmse_airspeed_mps"] / 3.0
