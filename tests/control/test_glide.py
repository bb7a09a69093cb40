"""After the thrust is gone: slower, at the best glide, still steered; back when thrust is back."""

import numpy as np
import pytest

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly


def glide(name: str, airspeed: int, effectiveness: float, *overrides: str):
    """Level for 120 s, all or nearly all thrust lost at 20 s, a turn of 60 deg from 60 s on."""
    return fly(
        load_scenario(
            "nominal",
            [
                "model=jsbsim",
                f"aircraft.name={name}",
                "duration=120",
                f"initial.airspeed={airspeed}",
                "initial.altitude=6000",
                f"reference.airspeed=[[0,{airspeed}]]",
                "reference.flight_path_deg=[[0,0]]",
                "reference.heading_deg=[[0,0],[60,0],[90,60]]",
                f'fault=[{{target="thrust",kind="loss-of-effectiveness",effectiveness={effectiveness},start=20}}]',
                *overrides,
            ],
        )
    )


@pytest.mark.parametrize(("name", "airspeed"), [("f16", 250), ("T38", 230)])
def test_dead_engine_becomes_a_glide_and_no_dive(name, airspeed):
    """Never steeper than 12 deg, at most 9 deg once it is steady; control kept, heading turned as asked for."""
    flight = glide(name, airspeed, 0.0)
    record, metrics = flight.record, flight_metrics(flight)
    path = np.degrees(record["flight_path_angle"])
    assert metrics["loss_of_control"] is None
    assert path.min() > -12.0
    assert path[-1000:].mean() > -9.0
    assert metrics["peak_airspeed_given_up_mps"] > 20.0
    assert np.degrees(record["heading"][-1]) == pytest.approx(60.0, abs=3.0)
    assert record["load_factor"].min() > 0.2


def test_airspeed_is_kept_where_a_shallow_descent_pays_for_it():
    """0.3 of the F-16's thrust at 300 m/s: nothing of the airspeed is given up, and no turn."""
    metrics = flight_metrics(glide("f16", 300, 0.3))
    assert metrics["rmse_airspeed_mps"] < 0.5
    assert metrics["peak_airspeed_given_up_mps"] < 0.1
    assert metrics["verdict"] == "inside limits"


def test_thrust_that_comes_back_brings_the_airspeed_back():
    """Repaired at 60 s by a ramp of 5 s: 1 m/s off at 110 s."""
    repaired = 'fault=[{target="thrust",kind="loss-of-effectiveness",effectiveness=0.0,start=20,end=60,fall=5}]'
    record = glide("f16", 250, 0.0, repaired).record
    assert record["airspeed"][5900] < 230.0
    assert record["airspeed"][11000] == pytest.approx(250.0, abs=1.0)
    assert record["airspeed_given_up"][11000] < 0.1
