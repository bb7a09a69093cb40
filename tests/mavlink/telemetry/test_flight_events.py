"""What a ground station is told of a flight, and when."""

import numpy as np

from ftc_jsb.mavlink.telemetry.flight_events import LONGEST_TEXT, FlightEvents


def told(flight, step=1000000):
    """Times [s] and texts, looked for `step` rows at a time."""
    finder, record = FlightEvents(flight.scenario), flight.record
    events = []
    for first in range(0, record.size, step):
        events += finder.find(record, first, min(first + step, record.size))
    return [(round(float(record["time"][e.row]), 2), e.text) for e in events]


def test_fault_of_the_paper_is_told_as_it_is_found(flown):
    """Injected at 20 s, detected 0.28 s later, isolated when the estimate has settled."""
    events = told(flown("paper"))
    assert events[0] == (20.0, "fault injected: thrust 0.60")
    assert events[1] == (20.28, "fault detected")
    assert events[2][1] == "fault isolated: thrust 0.60"
    assert 20.5 < events[2][0] < 21.5
    assert len(events) == 3


def test_it_does_not_matter_how_often_one_looks(flown):
    for scenario in ("intermittent", "ramp"):
        flight = flown(scenario)
        assert told(flight, 1) == told(flight, 7) == told(flight)


def test_recovery_is_told(flown):
    texts = [text for _, text in told(flown("intermittent"))]
    for text in ("fault removed: thrust", "recovered: no fault declared"):
        assert texts.count(text) == 5


def test_ramp_is_one_fault(flown):
    texts = [text for _, text in told(flown("ramp"))]
    assert sum("injected" in text for text in texts) == 1


def test_limits_are_told_when_near_and_when_broken(flown):
    """Without FTC airspeed falls 2.9 m/s after the fault: near 2.8 of [-3, 3], broken of [-2, 2]."""
    for bound, word in ((3.0, "near"), (2.0, "broken")):
        flight = flown("paper", "loop.name=no-ftc", f"limits.error_airspeed=[{-bound},{bound}]")
        events = [event for event in told(flight) if "limit" in event[1]]
        assert events[-1][1].startswith(f"limit {word}: error_airspeed -")
        assert all(time > 20.0 for time, _ in events)
        assert sum(word in text for _, text in events) == 1


def test_references_that_cannot_be_flown_are_told_and_when_they_can_be_again(flown):
    """0.3 of the thrust pays for no climb of 5 deg in a turn, and for level flight at the end."""
    events = [text for time, text in told(flown("speed-first")) if time > 20.0]
    short = [text for text in events if "attainable" in text]
    assert short[0].startswith("references not attainable: -")
    assert "references attainable again" in short


def test_texts_fit_their_field(flown):
    flight = flown("severe", "model=jsbsim")
    assert all(len(text) <= LONGEST_TEXT for _, text in told(flight))
    assert np.all(np.diff([time for time, _ in told(flight)]) >= 0.0)
