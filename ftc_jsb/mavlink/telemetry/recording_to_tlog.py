"""A recording as the telemetry that its flight would have sent at the default rates."""

from pathlib import Path

import numpy as np
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.link.encoder import Encoder
from ftc_jsb.mavlink.link.telemetry_log import TelemetryLog
from ftc_jsb.mavlink.telemetry.flight_events import FlightEvents
from ftc_jsb.mavlink.telemetry.message_streams import StreamSchedule, message_fields
from ftc_jsb.mavlink.telemetry.snapshot import LinkHealth, Phase, SnapshotBuilder
from ftc_jsb.recording.flight import Flight


def write_tlog(flight: Flight, path: Path) -> None:
    """Write a telemetry log of a flight; a recording has no date, so the log begins in 1970.

    Raises:
        WriteError: it cannot be written.
    """
    record = flight.record
    time = 0.0
    schedule = StreamSchedule(lambda: time)
    encoder, snapshots = Encoder(1), SnapshotBuilder(flight.scenario)
    events = FlightEvents(flight.scenario).find(record, 0, record.size)
    with TelemetryLog(path) as log:
        while time <= float(record["time"][-1]):
            i = max(int(np.searchsorted(record["time"], time, side="right")) - 1, 0)
            while events and events[0].row <= i:
                event = events.pop(0)
                fields = {"severity": event.severity, "text": event.text}
                log.write(encoder.frame(dialect.MAVLink_statustext_message, fields), time)
            snapshot = snapshots.at(record, i, Phase.FLYING, time, LinkHealth())
            for stream in schedule.due():
                for fields in message_fields(stream, snapshot):
                    log.write(encoder.frame(stream.message, fields), time)
            time = schedule.next()
