"""Which of the messages that come in are for this vehicle, and what handles each."""

import time
from collections.abc import Callable
from typing import Any

from ftc_jsb.mavlink.commands.command_protocol import CommandProtocol
from ftc_jsb.mavlink.commands.link_services import LinkServices
from ftc_jsb.mavlink.commands.parameter_protocol import ParameterProtocol
from ftc_jsb.mavlink.commands.unsupported_services import UnsupportedServices
from ftc_jsb.mavlink.commands.vehicle_access import VehicleAccess
from ftc_jsb.mavlink.link.encoder import COMPONENT
from ftc_jsb.mavlink.link.telemetry_log import TelemetryLog
from ftc_jsb.mavlink.link.vehicle_link import Link


class MessageDispatcher:
    """Hands messages that are meant for the vehicle to their handlers."""

    def __init__(self, vehicle: VehicleAccess, link: Link, log: TelemetryLog | None) -> None:
        """Args: the vehicle; its identity; where what is acted on is logged."""
        self.ignored = 0  # messages not for us, or on a link that is read-only
        self._vehicle, self._link, self._log = vehicle, link, log
        self._commands = commands = CommandProtocol(vehicle)
        parameters = ParameterProtocol(vehicle)
        services, unsupported = LinkServices(vehicle), UnsupportedServices(vehicle)
        self._handlers: dict[str, Callable[[Any], None]] = {
            "COMMAND_LONG": commands.command_long,
            "COMMAND_INT": commands.command_int,
            "PARAM_REQUEST_LIST": parameters.param_request_list,
            "PARAM_REQUEST_READ": parameters.param_request_read,
            "PARAM_SET": parameters.param_set,
            "MISSION_REQUEST_LIST": unsupported.mission_request_list,
            "MISSION_COUNT": unsupported.mission_count,
            "MISSION_REQUEST": unsupported.mission_request,
            "MISSION_REQUEST_INT": unsupported.mission_request,
            "MISSION_CLEAR_ALL": unsupported.mission_clear_all,
            "MISSION_REQUEST_PARTIAL_LIST": unsupported.mission_request,
            "MISSION_WRITE_PARTIAL_LIST": unsupported.mission_count,
            "MISSION_ITEM": unsupported.mission_count,
            "MISSION_ITEM_INT": unsupported.mission_count,
            "MISSION_SET_CURRENT": unsupported.mission_set_current,
            "LOG_REQUEST_LIST": unsupported.log_request_list,
            "LOG_REQUEST_DATA": unsupported.log_request_data,
            "LOG_ERASE": unsupported.not_followed,
            "SET_ATTITUDE_TARGET": unsupported.not_followed,
            "SET_POSITION_TARGET_LOCAL_NED": unsupported.not_followed,
            "SET_POSITION_TARGET_GLOBAL_INT": unsupported.not_followed,
            "MANUAL_CONTROL": unsupported.not_followed,
            "RC_CHANNELS_OVERRIDE": unsupported.not_followed,
            "FILE_TRANSFER_PROTOCOL": unsupported.file_transfer_protocol,
            "TIMESYNC": services.timesync,
            "PING": services.ping,
            "REQUEST_DATA_STREAM": services.request_data_stream,
            "SET_MODE": unsupported.set_mode,
        }

    def restart(self) -> None:
        """A flight begins anew."""
        self._commands.restart()

    def dispatch(self, message: Any) -> None:
        """Act on a message that has come through."""
        handler = self._handlers.get(message.get_type())
        station = message.get_srcSystem(), message.get_srcComponent()
        if not self._link.readonly and station != (self._link.system, COMPONENT):
            self._vehicle.station = station
            self._vehicle.schedule.hear(station)
        if handler is None:
            return
        if self._link.readonly or not self._is_for_us(message):
            self.ignored += 1
            return
        if self._log is not None:
            self._log.write(bytes(message.get_msgbuf()), time.time())
        handler(message)

    def _is_for_us(self, message: Any) -> bool:
        """Whether it is addressed to the vehicle, or to all, and not its own that came back."""
        system, component = message.get_srcSystem(), message.get_srcComponent()
        echo = system == self._link.system and component == COMPONENT
        to_system = getattr(message, "target_system", 0) in (0, self._link.system)
        to_component = getattr(message, "target_component", 0) in (0, COMPONENT)
        return to_system and to_component and not echo
