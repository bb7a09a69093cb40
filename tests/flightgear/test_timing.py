"""Time as the simulator has it: each line's place after the one before, pauses and silence by the clock."""

import pytest

from ftc_jsb.flightgear.timing import PAUSED, Arrival, Clock, Moment, arrival

LAST = Moment(1200, 10.0)


@pytest.mark.parametrize(
    ("frame", "time", "expected"),
    [
        (1205, 10.0 + 5 / 120, Arrival.NEXT),
        (1320, 11.0, Arrival.NEXT),  # frames were dropped: a longer step
        (1200, 10.0, Arrival.REPEATED),
        (1195, 10.0 - 5 / 120, Arrival.DISORDERED),
        (1201, 10.0 + 1 / 120, Arrival.SURPLUS),  # sooner than 100 Hz
        (30, 0.25, Arrival.RESET),
    ],
)
def test_a_line_after_the_last(frame, time, expected):
    assert arrival(LAST, Moment(frame, time), 0.00999) is expected


def test_the_first_line_is_the_first():
    assert arrival(None, Moment(7, 0.1), 0.01) is Arrival.FIRST


def test_a_pause_is_lines_without_new_frames_and_silence_none_at_all():
    clock = Clock()
    clock.heard(100.0, moved=True)
    assert not clock.paused(100.1)
    clock.heard(100.0 + 2 * PAUSED, moved=False)
    assert clock.paused(100.0 + 2 * PAUSED)
    assert not clock.silent(101.0, 1.0)
    assert clock.silent(103.0, 1.0)
    assert not clock.paused(103.0)
    clock.heard(103.0, moved=True)
    assert not clock.paused(103.1)
