"""PARAM_REQUEST_LIST, PARAM_REQUEST_READ and PARAM_SET, each answered at once."""

from typing import Any

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.commands.parameters import plain
from ftc_jsb.mavlink.commands.vehicle_access import Desk
from ftc_jsb.mavlink.telemetry.status import IN_THE_AIR

REAL32 = dialect.MAV_PARAM_TYPE_REAL32  # of every parameter


class ParameterProtocol:
    """Answers questions about parameters."""

    def __init__(self, desk: Desk) -> None:
        """Args: the vehicle."""
        self._desk = desk

    def param_request_list(self, message: Any) -> None:
        """All of them."""
        for index in range(len(self._desk.parameters.all)):
            self._send(index)

    def param_request_read(self, message: Any) -> None:
        """One, by its index or by its name."""
        index: int | None = message.param_index
        if message.param_index < 0:
            index = self._desk.parameters.find(message.param_id)
        if index is None or index >= len(self._desk.parameters.all):
            self._refuse(message, dialect.MAV_PARAM_ERROR_DOES_NOT_EXIST, message.param_index)
        else:
            self._send(index)

    def param_set(self, message: Any) -> None:
        """A new value; a refusal is sent back with the true one."""
        index = self._desk.parameters.find(message.param_id)
        if index is None:
            self._refuse(message, dialect.MAV_PARAM_ERROR_DOES_NOT_EXIST, -1)
            return
        problem = self._set(message)
        if problem is not None:
            error, reason = problem
            self._refuse(message, error, index)
            self._desk.say(dialect.MAV_SEVERITY_NOTICE, f"refused: {message.param_id}: {reason}")
        self._send(index)

    def _set(self, message: Any) -> tuple[int, str] | None:
        """Set the value, or say what is wrong with it."""
        parameters = self._desk.parameters
        if message.param_type != REAL32:
            return dialect.MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE, "expected REAL32"
        parameter = parameters.all[parameters.find(message.param_id) or 0]
        if parameter.key and self._desk.snapshot().phase not in IN_THE_AIR:
            return dialect.MAV_PARAM_ERROR_PERMISSION_DENIED, "not in flight"
        if not parameters.set(message.param_id, plain(message.param_value), self._desk.give):
            return dialect.MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE, "out of range"
        return None

    def _send(self, index: int) -> None:
        parameters = self._desk.parameters
        name = parameters.all[index].name
        fields = {
            "param_id": name,
            "param_value": parameters[name],
            "param_type": REAL32,
            "param_count": len(parameters.all),
            "param_index": index,
        }
        self._desk.send(dialect.MAVLink_param_value_message, fields)

    def _refuse(self, message: Any, error: int, index: int) -> None:
        fields = {
            "target_system": message.get_srcSystem(),
            "target_component": message.get_srcComponent(),
            "param_id": message.param_id,
            "param_index": index,
            "error": error,
        }
        self._desk.send(dialect.MAVLink_param_error_message, fields)
