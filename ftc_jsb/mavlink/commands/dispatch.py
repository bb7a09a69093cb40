"""Who is listened to, and which answer each message gets."""

import time
from collections.abc import Callable
from typing import Any

from ftc_jsb.mavlink.commands.command_protocol import CommandProtocol
from ftc_jsb.mavlink.commands.other_requests import Answers
from ftc_jsb.mavlink.commands.parameter_protocol import ParameterProtocol
from ftc_jsb.mavlink.commands.vehicle_access import Desk
from ftc_jsb.mavlink.link.encoder import COMPONENT
from ftc_jsb.mavlink.link.link import Link
from ftc_jsb.mavlink.link.telemetry_log import TelemetryLog


class Conversation:
    """Hands messages that are meant for the vehicle to what answers them."""

    def __init__(self, desk: Desk, link: Link, log: TelemetryLog | None) -> None:
        """Args: the vehicle; its identity; where what is acted on is logged."""
        self.ignored = 0  # messages not for us, or on a link that is read-only
        self._link, self._log = link, log
        commands, parameters, answers = (
            CommandProtocol(desk),
            ParameterProtocol(desk),
            Answers(desk),
        )
        self._commands = commands
        self._handlers: dict[str, Callable[[Any], None]] = {
            "COMMAND_LONG": commands.command_long,
            "COMMAND_INT": commands.command_int,
            "PARAM_REQUEST_LIST": parameters.param_request_list,
            "PARAM_REQUEST_READ": parameters.param_request_read,
            "PARAM_SET": parameters.param_set,
            "MISSION_REQUEST_LIST": answers.mission_request_list,
            "MISSION_COUNT": answers.mission_count,
            "MISSION_REQUEST": answers.mission_request,
            "MISSION_REQUEST_INT": answers.mission_request,
            "MISSION_CLEAR_ALL": answers.mission_clear_all,
            "FILE_TRANSFER_PROTOCOL": answers.file_transfer_protocol,
            "TIMESYNC": answers.timesync,
            "PING": answers.ping,
            "REQUEST_DATA_STREAM": answers.request_data_stream,
            "SET_MODE": answers.set_mode,
        }

    def restart(self) -> None:
        """A flight begins anew."""
        self._commands.restart()

    def hear(self, message: Any) -> None:
        """Act on a message that has come through."""
        handler = self._handlers.get(message.get_type())
        if handler is None:
            return
        ours = (0, self._link.system)
        echo = (
            message.get_srcSystem() == self._link.system and message.get_srcComponent() == COMPONENT
        )
        system = getattr(message, "target_system", 0)
        component = getattr(message, "target_component", 0)
        if self._link.readonly or echo or system not in ours or component not in (0, COMPONENT):
            self.ignored += 1
            return
        if self._log is not None:
            self._log.write(bytes(message.get_msgbuf()), time.time())
        handler(message)
