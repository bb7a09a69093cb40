"""The fault timeline: what happened, from when to when, in agreement with the flight's metrics."""

import numpy as np
import pytest

from ftc_jsb.analysis.fault_timeline import (
    DECLARED,
    EVENTS,
    FAULT,
    ISOLATED,
    LIMIT,
    LOST,
    SUSPECTED,
    fault_timeline,
)
from ftc_jsb.analysis.metrics import flight_metrics


def of(flight, event):
    return [stretch for stretch in fault_timeline(flight) if stretch.event == event]


def test_a_tolerated_fault_sets_in_and_is_declared(flown):
    """The paper's fault at 20 s, to the end; declared when the metrics say so, and nothing else."""
    flight = flown("paper", "model=jsbsim")
    timeline = fault_timeline(flight)
    assert [stretch.event for stretch in timeline] == [FAULT, DECLARED]
    assert timeline[0][1:] == ("thrust", 20.0, 60.0)
    delay = flight_metrics(flight)["detection_delay_s"]
    assert timeline[1].from_s - 20.0 == pytest.approx(delay)


def test_nothing_happens_in_a_healthy_flight(flown):
    assert fault_timeline(flown("nominal")) == []


def test_limits_are_broken_and_control_is_lost_when_the_metrics_say_so(flown):
    """Without thrust and without FTC: the first sample outside each limit, none after control is lost."""
    flight = flown("total-loss", "model=jsbsim", "loop.name=no-ftc")
    metrics = flight_metrics(flight)
    first = {}
    for stretch in of(flight, LIMIT):
        first.setdefault(stretch.what, stretch.from_s)
    assert first == {each["name"]: each["time"] for each in metrics["limits_broken"]}
    (lost,) = of(flight, LOST)
    assert (lost.from_s, lost.what) == (
        metrics["loss_of_control_time_s"],
        metrics["loss_of_control"],
    )
    assert all(stretch.to_s <= lost.from_s for stretch in of(flight, LIMIT))


def test_who_is_isolated_and_when_is_that_of_the_metrics(flown):
    flight = flown("turbulence", "model=jsbsim", "loop.name=robust")
    found = of(flight, ISOLATED)
    assert found[0].what == "thrust"
    delay = flight_metrics(flight)["isolation_delay_s"]
    assert found[0].from_s - 20.0 == pytest.approx(delay)


def test_suspicion_below_the_safe_probability_is_no_isolation(flown):
    """A recording altered by hand: thrust suspected at 0.5 from 21 s, at 0.95 from 22 s."""
    flight = flown("turbulence", "model=jsbsim", "loop.name=robust")
    record = flight.record.copy()
    time = record["time"]
    record["suspect"] = np.where(time >= 21.0, 1.0, 0.0)
    record["suspect_probability"] = np.where(time >= 22.0, 0.95, np.where(time >= 21.0, 0.5, 1.0))
    altered = flight._replace(record=record)
    assert [s[1:] for s in of(altered, SUSPECTED)] == [("thrust", 21.0, 22.0)]
    assert [s[1:] for s in of(altered, ISOLATED)] == [("thrust", 22.0, time[-1])]


def test_what_pauses_shortly_goes_on(flown):
    """Declarations altered by hand: 0.2 s without one joins, 2 s do not."""
    flight = flown("paper")
    record = flight.record.copy()
    time = record["time"]
    record["fault_declared"] = (
        (time > 30) & (time < 31) | (time > 31.2) & (time < 32) | (time > 34)
    ).astype(float)
    stretches = of(flight._replace(record=record), DECLARED)
    assert [(round(s.from_s, 1), round(s.to_s, 1)) for s in stretches] == [
        (30.0, 32.0),
        (34.0, 60.0),
    ]


def test_events_come_in_the_order_of_a_fault(flown):
    flight = flown("total-loss", "model=jsbsim", "loop.name=no-ftc")
    events = [stretch.event for stretch in fault_timeline(flight)]
    assert events == sorted(events, key=EVENTS.index)
    assert len(set(events)) >= 4
