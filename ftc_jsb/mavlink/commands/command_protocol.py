"""COMMAND_LONG and COMMAND_INT: one COMMAND_ACK for each."""

from typing import Any

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.commands.acknowledgement import UNSUPPORTED, Handlers, Params, Reply
from ftc_jsb.mavlink.commands.failure_command import FailureCommand
from ftc_jsb.mavlink.commands.flight_commands import CourseCommands
from ftc_jsb.mavlink.commands.message_requests import MessageRequests
from ftc_jsb.mavlink.commands.set_point_commands import SetPointCommands
from ftc_jsb.mavlink.commands.vehicle_access import Desk


class CommandProtocol:
    """Answers commands."""

    def __init__(self, desk: Desk) -> None:
        """Args: the vehicle."""
        self._desk = desk
        self._failures = FailureCommand(desk)
        self.handlers: Handlers = {
            **self._failures.handlers,
            **SetPointCommands(desk).handlers,
            **CourseCommands(desk).handlers,
            **MessageRequests(desk).handlers,
        }

    def restart(self) -> None:
        """A flight begins anew."""
        self._failures.restart()

    def command_long(self, message: Any) -> None:
        """Answer a COMMAND_LONG."""
        self._answer(message, tuple(getattr(message, f"param{k}") for k in range(1, 8)))

    def command_int(self, message: Any) -> None:
        """Answer a COMMAND_INT."""
        four = tuple(getattr(message, f"param{k}") for k in range(1, 5))
        self._answer(message, (*four, message.x, message.y, message.z))

    def _answer(self, message: Any, params: Params) -> None:
        handler = self.handlers.get(message.command)
        reply = handler(params) if handler else Reply(UNSUPPORTED)
        self._desk.send(
            dialect.MAVLink_command_ack_message,
            {
                "command": message.command,
                "result": reply.result,
                "target_system": message.get_srcSystem(),
                "target_component": message.get_srcComponent(),
            },
        )
        if reply.reason:
            self._desk.say(dialect.MAV_SEVERITY_NOTICE, reply.reason)
