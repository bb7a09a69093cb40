"""A recording as the telemetry that its flight would have sent at the default rates."""

from collections import deque
from pathlib import Path

import numpy as np
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.link.encoder import Encoder
from ftc_jsb.mavlink.link.telemetry_log import TelemetryLog
from ftc_jsb.mavlink.telemetry.flight_events import Event, FlightEvents
from ftc_jsb.mavlink.telemetry.message_streams import StreamSchedule, message_fields
from ftc_jsb.mavlink.telemetry.snapshot import LinkHealth, Phase, SnapshotBuilder
from ftc_jsb.recording.flight import Flight

EVENT_INTERVAL = 0.1  # [s] of flight between searches for events


def write_tlog(flight: Flight, path: Path) -> None:
    """Write a telemetry log of a flight; a recording has no date, so the log begins in 1970.

    Raises:
        WriteError: it cannot be written.
    """
    record = flight.record
    time = 0.0
    schedule = StreamSchedule(lambda: time)
    encoder, snapshots = Encoder(1), SnapshotBuilder(flight.scenario)
    events, searched = FlightEvents(flight.scenario), 0
    beyond = max(round(EVENT_INTERVAL / flight.row_period), 1)  # rows of a search
    said: deque[Event] = deque()
    with TelemetryLog(path) as log:
        while time <= float(record["time"][-1]):
            i = max(int(np.searchsorted(record["time"], time, side="right")) - 1, 0)
            while searched <= i:
                found = events.find(record, searched, min(searched + beyond, record.size))
                searched += beyond
                said.extend(found)
            while said and said[0].row <= i:
                event = said.popleft()
                fields = {"severity": event.severity, "text": event.text}
                log.write(encoder.frame(dialect.MAVLink_statustext_message, fields), time)
            snapshot = snapshots.at(record, i, Phase.FLYING, time, LinkHealth())
            snapshot = snapshot._replace(critical=events.critical)
            for stream in schedule.due():
                for fields in message_fields(stream, snapshot):
                    log.write(encoder.frame(stream.message, fields), time)
            time = schedule.next()
