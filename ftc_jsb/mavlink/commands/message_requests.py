"""Commands that ask for messages, once or at a rate."""

import math

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.commands.acknowledgement import (
    ACCEPTED,
    DENIED,
    REJECTED,
    UNSUPPORTED,
    Handlers,
    Params,
    Reply,
    whole,
)
from ftc_jsb.mavlink.commands.other_requests import autopilot_version
from ftc_jsb.mavlink.commands.vehicle_access import Desk
from ftc_jsb.mavlink.telemetry.status import home_position
from ftc_jsb.mavlink.telemetry.streams import BY_ID, contents


class MessageRequests:
    """Messages by command."""

    def __init__(self, desk: Desk) -> None:
        """Args: the vehicle."""
        self._desk = desk
        self.handlers: Handlers = {
            dialect.MAV_CMD_SET_MESSAGE_INTERVAL: self._set_interval,
            dialect.MAV_CMD_GET_MESSAGE_INTERVAL: self._get_interval,
            dialect.MAV_CMD_REQUEST_MESSAGE: self._request_message,
            dialect.MAV_CMD_GET_HOME_POSITION: self._home,
            dialect.MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES: self._capabilities,
        }

    def _set_interval(self, params: Params) -> Reply:
        message, interval = whole(params[0]), params[1]
        stream = BY_ID.get(message)
        if stream is None:
            return Reply(UNSUPPORTED)
        if interval == 0.0:
            rate = stream.rate
        elif interval < 0.0:
            rate = 0.0
        else:
            rate = 1e6 / interval
        done = math.isfinite(rate) and self._desk.timetable.set_rate(message, rate)
        return Reply(ACCEPTED if done else DENIED)

    def _get_interval(self, params: Params) -> Reply:
        message = whole(params[0])
        if not 0 <= message < 2**16:
            return Reply(DENIED)
        rate = self._desk.timetable.rate(message)
        interval = 1e6 / rate if rate else -1 if message in BY_ID else 0  # 0: not available
        self._desk.send(
            dialect.MAVLink_message_interval_message,
            {"message_id": message, "interval_us": interval},
        )
        return Reply(ACCEPTED)

    def _request_message(self, params: Params) -> Reply:
        message = whole(params[0])
        if message == dialect.MAVLink_autopilot_version_message.id:
            return self._capabilities(params)
        stream = BY_ID.get(message)
        if stream is None:
            return Reply(UNSUPPORTED)
        sent = False
        for fields in contents(stream, self._desk.snapshot()):
            self._desk.send(stream.message, fields)
            sent = True
        return Reply(ACCEPTED if sent else REJECTED)

    def _home(self, params: Params) -> Reply:
        fields = home_position(self._desk.snapshot())
        self._desk.send(dialect.MAVLink_home_position_message, fields)
        return Reply(ACCEPTED)

    def _capabilities(self, params: Params) -> Reply:
        self._desk.send(dialect.MAVLink_autopilot_version_message, autopilot_version())
        return Reply(ACCEPTED)
