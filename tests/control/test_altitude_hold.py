"""Altitude as a reference: reached, held in moving air, followed as far as thrust goes."""

import numpy as np
import pytest

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.errors import ScenarioError
from ftc_jsb.recording.commands import Applied, SetAltitude
from ftc_jsb.scenario.load import load_scenario, parse_scenario
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.command_source import RecordedCommands
from ftc_jsb.simulation.fly import fly

STEP = 5200.0  # [m], from 5000 at 20 s


def to_altitude(
    model: str, *overrides: str, altitude: str = f"[[0,5000],[20,5000],[20.01,{STEP}]]"
):
    """250 m/s straight ahead at 5000 m, then 200 m higher."""
    text = f"""
name = "altitude"
duration = 80.0
model = "{model}"
[initial]
airspeed = 250.0
altitude = 5000.0
[reference]
airspeed = [[0, 250]]
altitude = {altitude}
heading_deg = [[0, 0]]
"""
    scenario = parse_scenario(text, "text")
    values = scenario.model_dump(mode="json")
    for override in overrides:
        section, key, value = override.split(" ")
        values[section][key] = value
    return Scenario.model_validate(values)


@pytest.mark.parametrize("model", ["paper", "identified", "jsbsim"])
def test_new_altitude_is_reached_without_overshoot(model):
    """Within 0.3 m from 60 s on, never 1 m above, on a path of 5 deg: the one that is asked for."""
    record = fly(to_altitude(model)).record
    late = record["time"] > 60.0
    assert record["altitude"][late] == pytest.approx(np.full(late.sum(), STEP), abs=0.3)
    assert record["altitude"].max() < STEP + 1.0
    assert np.degrees(record["flight_path_angle"]).max() == pytest.approx(5.0, abs=0.4)
    climbing = (record["time"] > 22.0) & (record["time"] < 60.0)
    off = np.abs(record["altitude"] - record["altitude_ref"])[climbing]
    assert off.max() < 2.0  # [m], from the plan


@pytest.mark.parametrize("seed", [11, 12])
def test_altitude_is_held_in_moderate_turbulence(seed):
    """Within 5 m of the altitude that is measured without bias, RMS 2 m: instruments and loop of the field."""
    scenario = to_altitude("jsbsim", "wind turbulence moderate", "loop name robust")
    record = fly(scenario.model_copy(update={"seed": seed, "duration": 180.0})).record
    off = (record["altitude"] - STEP)[record["time"] > 70.0]
    assert np.abs(off).max() < 5.0
    assert np.sqrt(np.mean(off**2)) < 2.0


def test_updraught_does_not_carry_the_aircraft_away():
    """5 m/s upwards for 40 s: 200 m if nothing closed the loop; 4 m while it comes, 0.5 m once it is known."""
    scenario = to_altitude("identified", altitude="[[0,5000]]")
    values = scenario.model_dump(mode="json")
    values["wind"]["gust"] = [{"updraught": 5.0, "start": 20.0, "length": 2.0, "hold": 40.0}]
    record = fly(Scenario.model_validate(values)).record
    off = np.abs(record["altitude"] - 5000.0)
    assert off.max() < 4.0
    assert off[(record["time"] > 40.0) & (record["time"] < 60.0)].max() < 0.5


def test_unattainable_altitude_is_flown_as_far_as_it_goes_and_said():
    """2000 m above, at 15 deg, on a third of the thrust: 4 m/s are lost in the pull-up and come back."""
    scenario = to_altitude(
        "identified", "reference climb_deg 15", altitude="[[0,5000],[10,5000],[11,7000]]"
    )
    values = scenario.model_dump(mode="json")
    values["fault"] = [{"effectiveness": 0.3, "start": 5.0}]
    flight = fly(Scenario.model_validate(values))
    metrics = flight_metrics(flight)
    assert metrics["peak_error_airspeed_mps"] < 5.0
    assert flight.record["airspeed"][-1] == pytest.approx(250.0, abs=0.5)
    assert metrics["unattainable_fraction"] > 0.5
    assert metrics["loss_of_control"] is None
    assert flight.record["altitude"][-1] > 5000.0
    assert (
        np.abs(flight.record["altitude_ref"] - flight.record["altitude"]).max() < 25.0
    )  # it waits


def test_altitude_is_commanded_in_flight_while_the_altimeter_is_silent():
    """Nothing breaks, and it is reached within 0.5 m once the altitude is measured, from 20 s on."""
    values = to_altitude("identified", altitude="[[0,5000]]").model_dump(mode="json")
    values["reference"] |= {"altitude": None, "flight_path_deg": [[0, 0]]}
    values["fault"] = [{"target": "altitude", "kind": "dropout", "start": 0.0, "end": 20.0}]
    command = Applied(500, SetAltitude(value=5010.0, flight_path=0.05, rate=0.02))
    record = fly(Scenario.model_validate(values), commands=RecordedCommands([command])).record
    assert np.all(np.isfinite(record["flight_path_angle_cmd_raw"]))
    assert np.abs(np.degrees(record["flight_path_angle"])).max() < 8.0
    assert record["altitude"][-1] == pytest.approx(5010.0, abs=0.5)


@pytest.mark.parametrize(
    ("override", "words"),
    [
        ("reference.altitude=[[0,5000]]", "both given; expected flight_path_deg or altitude"),
        ("reference.climb_deg=50", "climb_deg"),
    ],
)
def test_contradiction_is_refused(override, words):
    with pytest.raises(ScenarioError, match=words):
        load_scenario("paper", [override])
