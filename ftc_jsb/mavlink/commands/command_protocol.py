"""COMMAND_LONG and COMMAND_INT: one COMMAND_ACK for each."""

from typing import Any

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.commands.command_handlers import Acknowledgement, Handlers, Params, Result
from ftc_jsb.mavlink.commands.failure_command import FailureCommand
from ftc_jsb.mavlink.commands.flight_phase_commands import FlightPhaseCommands
from ftc_jsb.mavlink.commands.message_request_commands import MessageRequestCommands
from ftc_jsb.mavlink.commands.set_point_commands import SetPointCommands
from ftc_jsb.mavlink.commands.vehicle_access import VehicleAccess
from ftc_jsb.mavlink.link.message_fields import addressed_to_sender


class CommandProtocol:
    """Acts on commands and acknowledges them."""

    def __init__(self, vehicle: VehicleAccess) -> None:
        """Args: the vehicle that is commanded."""
        self._vehicle = vehicle
        self._failures = FailureCommand(vehicle)
        self.handlers: Handlers = {
            **self._failures.handlers(),
            **SetPointCommands(vehicle).handlers(),
            **FlightPhaseCommands(vehicle).handlers(),
            **MessageRequestCommands(vehicle).handlers(),
        }

    def restart(self) -> None:
        """A flight begins anew."""
        self._failures.restart()

    def command_long(self, message: Any) -> None:
        """Act on a COMMAND_LONG."""
        self._acknowledge(message, tuple(getattr(message, f"param{k}") for k in range(1, 8)))

    def command_int(self, message: Any) -> None:
        """Act on a COMMAND_INT."""
        four = tuple(getattr(message, f"param{k}") for k in range(1, 5))
        self._acknowledge(message, (*four, message.x, message.y, message.z))

    def _acknowledge(self, message: Any, params: Params) -> None:
        handler = self.handlers.get(message.command)
        ack = handler(params) if handler else Acknowledgement(Result.UNSUPPORTED)
        self._vehicle.send(
            dialect.MAVLink_command_ack_message,
            {
                "command": message.command,
                "result": ack.result,
                **addressed_to_sender(message),
            },
        )
        if ack.result is Result.ACCEPTED:
            text = ack.reason
        else:
            why = ack.reason.removeprefix("refused: ") or ack.result.name.lower()
            text = f"refused: {_short_name(message.command)}: {why}"
        if text:
            self._vehicle.send_text(dialect.MAV_SEVERITY_NOTICE, text)


def _short_name(command: int) -> str:
    """A MAV_CMD without what all have, so that the reason has room in a STATUSTEXT."""
    known = dialect.enums["MAV_CMD"].get(command)
    name = known.name.removeprefix("MAV_CMD_") if known else f"command {command}"
    for prefix in ("GUIDED_", "DO_", "PREFLIGHT_", "COMPONENT_"):
        name = name.removeprefix(prefix)
    return str(name)[:20]
