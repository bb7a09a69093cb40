"""Servo monitor: a surface that does not obey, or a wrong pick-off? Fighters in a turn, tactical sensors."""

from typing import Any

import numpy as np
import pytest

from ftc_jsb.analysis.isolation import suspicions
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from ftc_jsb.vocabulary.hypotheses import HYPOTHESES
from tests.isolation.test_flights import START, flown, sensor

LOSS = '{{target="{}",kind="loss-of-effectiveness",effectiveness={},start={}}}'


def named(flight: Any) -> tuple[str, float]:
    """Whom the first decision names, and how long after the fault."""
    first = next(
        each
        for each in suspicions(flight)
        if each["suspect"] != HYPOTHESES[0] and each["probability"] >= 0.9
    )
    return first["suspect"], first["time_s"] - START


@pytest.mark.parametrize(
    ("aircraft", "surface", "effectiveness"),
    [("f16", "elevator", 0.5), ("f15", "aileron", 0.4), ("T38", "rudder", 0.5)],
)
def test_a_surface_that_lost_effect_is_named_within_a_second_and_a_half(
    aircraft: str, surface: str, effectiveness: float
) -> None:
    flight = flown(LOSS.format(surface, effectiveness, START), aircraft)
    who, delay = named(flight)
    assert who == surface
    assert 0.0 < delay < 1.5
    row: Any = flight.record
    assert not row["excluded"].any()  # what it reads is true
    assert row["suspect_probability"][row["suspect"] == HYPOTHESES.index(surface)].min() > 0.9


def test_a_stuck_elevator_is_no_pick_off() -> None:
    flight = flown(f'{{target="elevator",kind="stuck",start={START}}}')
    assert named(flight)[0] == "elevator"


def test_a_pick_off_that_is_wrong_is_no_elevator_and_where_it_was_sent_stands_in() -> None:
    """Within 0.3 deg of the truth from 2 s after the fault on, which is 2 deg."""
    flight = flown(sensor("elevator_position", "bias", ",size_deg=2"))
    assert named(flight)[0] == "elevator_position"
    row: Any = flight.record
    after = row["time"] > START + 2.0
    assert np.degrees(np.abs(row["elevator_meas"] - row["elevator"])[after]).mean() < 0.3


def test_a_surface_that_comes_back_is_suspect_no_longer() -> None:
    fault = LOSS.format("elevator", 0.5, START).replace("}", ",end=20.0}")
    flight = flown(fault)
    assert suspicions(flight)[-1]["suspect"] == HYPOTHESES[0]
    assert 20.0 < suspicions(flight)[-1]["time_s"] < 25.0


def test_with_perfect_sensors_a_loss_is_seen_too() -> None:
    flight = fly(
        load_scenario(
            "nominal",
            [
                "model=jsbsim",
                "loop.name=robust",
                "duration=20",
                f"fault=[{LOSS.format('elevator', 0.5, START)}]",
            ],
        )
    )
    assert named(flight)[0] == "elevator"


@pytest.mark.parametrize("kind", ["dropout", "freeze"])
def test_a_pick_off_that_says_nothing_is_no_surface(kind: str) -> None:
    """The aileron's, of the A-4: no surface is suspect; where it was sent stands in, within 0.5 deg."""
    flight = flown(sensor("aileron_position", kind), "A4")
    said = {each["suspect"] for each in suspicions(flight)}
    assert "aileron_position" in said
    assert "aileron" not in said
    row: Any = flight.record
    after = row["time"] > START + 1.0
    assert np.degrees(np.abs(row["aileron_meas"] - row["aileron"])[after]).mean() < 0.5
