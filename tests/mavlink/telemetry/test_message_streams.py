"""Messages are sent at their rates, and those that are late once."""

from collections import Counter

import pytest

from ftc_jsb.mavlink.telemetry.message_streams import STREAMS, StreamSchedule


def test_schedule_keeps_the_rates():
    """100 s of a clock that the test turns: each message as often as it should be, to one."""
    now = 0.0
    schedule = StreamSchedule(lambda: now)
    sent = Counter()
    while now < 100.0:
        sent.update(stream.id for stream in schedule.due())
        now = max(schedule.next(), now + 1e-3)
    for stream in STREAMS:
        assert sent[stream.id] == pytest.approx(100.0 * stream.rate, abs=1), stream.message.msgname


def test_late_messages_are_not_made_up_for():
    """After a second in which nothing ran, one of each, not 25."""
    now = 0.0
    schedule = StreamSchedule(lambda: now)
    now = 10.0
    assert len(schedule.due()) == len({stream.id for stream in STREAMS if stream.rate})
    assert schedule.due() == []
