"""Commands that ask for messages, once or at a rate."""

import math

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.commands.command_handlers import (
    Acknowledgement,
    CommandHandlers,
    Handlers,
    Params,
    Result,
    whole_number,
)
from ftc_jsb.mavlink.telemetry.message_streams import (
    BUDGET,
    HIGHEST_RATE,
    STREAM_BY_ID,
    message_fields,
)
from ftc_jsb.mavlink.telemetry.status_messages import autopilot_version, home_position


class MessageRequestCommands(CommandHandlers):
    """Messages by command."""

    def handlers(self) -> Handlers:
        """By MAV_CMD."""
        return {
            dialect.MAV_CMD_SET_MESSAGE_INTERVAL: self._set_interval,
            dialect.MAV_CMD_GET_MESSAGE_INTERVAL: self._get_interval,
            dialect.MAV_CMD_REQUEST_MESSAGE: self._request_message,
            dialect.MAV_CMD_GET_HOME_POSITION: self._home,
            dialect.MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES: self._capabilities,
        }

    def _set_interval(self, params: Params) -> Acknowledgement:
        message, interval = whole_number(params[0]), params[1]
        stream = STREAM_BY_ID.get(message)
        if stream is None:
            return Acknowledgement(Result.UNSUPPORTED)
        if interval == 0.0:
            rate = stream.rate
        elif interval < 0.0:
            rate = 0.0
        else:
            rate = 1e6 / interval
        schedule, station = self._vehicle.schedule, self._vehicle.station
        if math.isfinite(rate) and schedule.set_rate(message, rate, station):
            return Acknowledgement(Result.ACCEPTED)
        return Acknowledgement(
            Result.DENIED,
            f"refused: rate: {HIGHEST_RATE:g} Hz, in all {BUDGET:g}/s",
        )

    def _get_interval(self, params: Params) -> Acknowledgement:
        message = whole_number(params[0])
        if not 0 <= message < 2**16:
            return Acknowledgement(Result.DENIED)
        rate = self._vehicle.schedule.rate(message)
        interval = 1e6 / rate if rate else -1 if message in STREAM_BY_ID else 0  # 0: not available
        self._vehicle.send(
            dialect.MAVLink_message_interval_message,
            {"message_id": message, "interval_us": interval},
        )
        return Acknowledgement(Result.ACCEPTED)

    def _request_message(self, params: Params) -> Acknowledgement:
        message = whole_number(params[0])
        if message == dialect.MAVLink_autopilot_version_message.id:
            return self._capabilities(params)
        stream = STREAM_BY_ID.get(message)
        if stream is None:
            return Acknowledgement(Result.UNSUPPORTED)
        sent = False
        for fields in message_fields(stream, self._vehicle.snapshot()):
            self._vehicle.send(stream.message, fields)
            sent = True
        return Acknowledgement(Result.ACCEPTED if sent else Result.REJECTED)

    def _home(self, params: Params) -> Acknowledgement:
        fields = home_position(self._vehicle.snapshot())
        self._vehicle.send(dialect.MAVLink_home_position_message, fields)
        return Acknowledgement(Result.ACCEPTED)

    def _capabilities(self, params: Params) -> Acknowledgement:
        self._vehicle.send(dialect.MAVLink_autopilot_version_message, autopilot_version())
        return Acknowledgement(Result.ACCEPTED)
