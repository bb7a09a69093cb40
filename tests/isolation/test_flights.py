"""Fighters with tactical sensors, an instrument or the thrust at fault: who is named, and how it flies on."""

from typing import Any

import numpy as np
import pytest

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.recording.flight import Flight
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from ftc_jsb.vocabulary.signals import SENSED

START = 15.0  # [s]


def flown(fault: str, aircraft: str = "f16", air: str = "light", seed: int = 3) -> Flight:
    """Straight and level, a turn from 5 to 25 s; a fault at 15 s."""
    return fly(
        load_scenario(
            "nominal",
            [
                "model=jsbsim",
                "loop.name=robust",
                "sensors.profile=tactical",
                f"aircraft.name={aircraft}",
                "duration=35",
                f"seed={seed}",
                "initial.airspeed=240",
                "initial.altitude=4500",
                "reference.airspeed=[[0,240]]",
                "reference.flight_path_deg=[[0,0]]",
                "reference.heading_deg=[[0,0],[5,0],[25,60]]",
                f"wind.turbulence={air}",
                f"fault=[{fault}]",
            ],
        )
    )


def sensor(target: str, kind: str, size: str = "") -> str:
    return f'{{target="{target}",kind="{kind}",start={START}{size}}}'


FAULTS = {  # what fails, and in how many seconds it is named at the latest
    "airspeed": (sensor("airspeed", "bias", ",size=-20"), 6.0),
    "alpha": (sensor("alpha", "bias", ",size_deg=3"), 1.0),
    "sideslip": (sensor("sideslip", "freeze"), 0.5),
    "load_factor_x": (sensor("load_factor_x", "bias", ",size=-0.15"), 3.0),
    "load_factor_z": (sensor("load_factor_z", "bias", ",size=0.4"), 2.0),
    "roll_rate": (sensor("roll_rate", "bias", ",size_deg=4"), 1.0),
    "pitch_rate": (sensor("pitch_rate", "bias", ",size_deg=-4"), 1.0),
    "yaw_rate": (sensor("yaw_rate", "bias", ",size_deg=3"), 1.0),
    "pitch": (sensor("pitch", "freeze"), 0.5),
    "roll": (sensor("roll", "bias", ",size_deg=5"), 0.1),
    "altitude": (sensor("altitude", "dropout"), 0.2),
}


@pytest.mark.parametrize("name", FAULTS)
def test_the_instrument_at_fault_is_named_and_the_flight_goes_on(name: str) -> None:
    """Named in time, excluded at the end, k within 0.15 of 1 from 10 s after the fault on."""
    fault, latest = FAULTS[name]
    flight = flown(fault)
    metrics = flight_metrics(flight)
    assert flight.outcome.status == "complete"
    assert metrics["verdict"] != "loss of control"
    assert metrics["isolation_delay_s"] is not None
    assert metrics["isolation_delay_s"] <= latest
    row: Any = flight.record
    assert int(row["excluded"][-1]) >> SENSED.index(name) & 1
    last = row["time"] > 25.0
    assert np.abs(row["effectiveness_thrust_est"][last] - 1.0).max() < 0.15
    assert not row["fault_declared"][last].any()


def test_lost_thrust_is_lost_thrust() -> None:
    flight = flown(
        f'{{target="thrust",kind="loss-of-effectiveness",effectiveness=0.6,start={START}}}'
    )
    metrics = flight_metrics(flight)
    assert metrics["isolation_delay_s"] < 1.0
    assert metrics["false_suspicions"] == 0
    assert flight.record["excluded"].max() == 0
    assert flight.record["fault_declared"][-1] == 1


def test_nobody_is_suspect_where_nothing_is_wrong() -> None:
    """A healthy fighter in moderate turbulence: no suspicion, and readings as the instruments give them."""
    metrics = flight_metrics(flown("", "T38", "moderate"))
    assert metrics["suspicions"] == []
    assert metrics["false_alarms"] == 0


def test_an_instrument_that_recovers_is_believed_again() -> None:
    """A pitot that is silent from 15 to 20 s: excluded meanwhile, and 5 s later no longer."""
    flight = flown(f'{{target="airspeed",kind="dropout",start={START},end=20}}')
    row: Any = flight.record
    assert row["excluded"][row["time"].searchsorted(18.0)] == 1
    assert row["excluded"][-1] == 0
    assert np.abs(row["airspeed_meas"] - row["airspeed"])[row["time"] > 15.5].max() < 10.0


def test_without_isolation_readings_are_as_they_are() -> None:
    """The loop of the paper takes what the instruments say: a frozen vane stays frozen in the recording."""
    flight = fly(
        load_scenario(
            "nominal",
            [
                "model=jsbsim",
                "duration=20",
                "sensors.profile=tactical",
                f"fault=[{sensor('alpha', 'freeze')}]",
            ],
        )
    )
    row: Any = flight.record
    assert np.isnan(row["suspect"]).all()
    assert np.unique(row["alpha_meas"][row["time"] > START + 0.1]).size == 1
