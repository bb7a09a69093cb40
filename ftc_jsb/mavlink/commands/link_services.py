"""What ground stations ask of the link itself: TIMESYNC, PING, REQUEST_DATA_STREAM."""

from typing import Any

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.commands.vehicle_access import VehicleAccess
from ftc_jsb.mavlink.link.message_fields import addressed_to_sender


class LinkServices:
    """Answers each of these messages with one, or acts on it."""

    def __init__(self, vehicle: VehicleAccess) -> None:
        """Args: the vehicle that answers."""
        self._vehicle = vehicle

    def timesync(self, message: Any) -> None:
        """A request is answered with the vehicle's clock [ns], the time of flight; an answer with nothing."""
        if message.tc1 == 0:  # which says that it is a request, so that ours is never 0
            now = {"tc1": max(1e3 * self._vehicle.snapshot().time_usec, 1.0), "ts1": message.ts1}
            self._vehicle.send(dialect.MAVLink_timesync_message, now)

    def ping(self, message: Any) -> None:
        """Sent back to who asked."""
        if message.target_system == 0:
            fields = {
                "time_usec": message.time_usec,
                "seq": message.seq,
                **addressed_to_sender(message),
            }
            self._vehicle.send(dialect.MAVLink_ping_message, fields)

    def request_data_stream(self, message: Any) -> None:
        """The rate of a group of messages."""
        rate = float(message.req_message_rate) if message.start_stop else 0.0
        self._vehicle.schedule.set_group(message.req_stream_id, rate, self._vehicle.station)
