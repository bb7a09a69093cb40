"""PARAM_REQUEST_LIST, PARAM_REQUEST_READ and PARAM_SET, each answered at once."""

from typing import Any

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.commands.parameters import (
    as_bytes,
    float32_as_meant,
    integer_as_meant,
    is_in_bytes,
)
from ftc_jsb.mavlink.commands.vehicle_access import VehicleAccess
from ftc_jsb.mavlink.link.message_fields import addressed_to_sender

INTEGERS = (
    dialect.MAV_PARAM_TYPE_UINT8, dialect.MAV_PARAM_TYPE_INT8, dialect.MAV_PARAM_TYPE_UINT16,
    dialect.MAV_PARAM_TYPE_INT16, dialect.MAV_PARAM_TYPE_UINT32, dialect.MAV_PARAM_TYPE_INT32,
)  # fmt: skip
REAL32 = dialect.MAV_PARAM_TYPE_REAL32  # of every parameter


class ParameterProtocol:
    """Sends the parameters that are asked for, and sets them."""

    def __init__(self, vehicle: VehicleAccess) -> None:
        """Args: the vehicle that answers."""
        self._vehicle = vehicle

    def param_request_list(self, message: Any) -> None:
        """All of them."""
        for index in range(len(self._vehicle.parameters.all)):
            self._send(index)

    def param_request_read(self, message: Any) -> None:
        """One, by its index or by its name."""
        index: int | None = message.param_index
        if message.param_index < 0:
            index = self._vehicle.parameters.index_of(message.param_id)
        if index is None or index >= len(self._vehicle.parameters.all):
            self._refuse(message, dialect.MAV_PARAM_ERROR_DOES_NOT_EXIST, message.param_index)
        else:
            self._send(index)

    def param_set(self, message: Any) -> None:
        """A new value; a refusal is sent back with the true one."""
        index = self._vehicle.parameters.index_of(message.param_id)
        if index is None:
            self._refuse(message, dialect.MAV_PARAM_ERROR_DOES_NOT_EXIST, -1)
            return
        problem = self._set(message)
        if problem is not None:
            error, reason = problem
            self._refuse(message, error, index)
            self._vehicle.send_text(
                dialect.MAV_SEVERITY_NOTICE, f"refused: {message.param_id}: {reason}"
            )
        if problem is None and message.param_type in INTEGERS:
            self._send(index, message.param_type, is_in_bytes(message.param_value))
        else:
            self._send(index)

    def _set(self, message: Any) -> tuple[int, str] | None:
        """Set the value, or say what is wrong with it."""
        parameters = self._vehicle.parameters
        if message.param_type not in (REAL32, *INTEGERS):
            return dialect.MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE, "expected REAL32 or an integer"
        value = float32_as_meant(message.param_value)
        if message.param_type in INTEGERS:
            value = integer_as_meant(message.param_value)
        parameter = parameters.all[parameters.index_of(message.param_id) or 0]
        if parameter.key and not self._vehicle.snapshot().in_flight:
            return dialect.MAV_PARAM_ERROR_PERMISSION_DENIED, "not in flight"
        if not parameters.set(message.param_id, value, self._vehicle.queue_command):
            return dialect.MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE, parameters.bound(
                message.param_id, value
            )
        return None

    def _send(self, index: int, kind: int = REAL32, in_bytes: bool = False) -> None:
        """A parameter; as an integer for who set it so, in the bytes of the field where they were, too."""
        parameters = self._vehicle.parameters
        name = parameters.all[index].name
        fields = {
            "param_id": name,
            "param_value": as_bytes(parameters[name]) if in_bytes else parameters[name],
            "param_type": kind,
            "param_count": len(parameters.all),
            "param_index": index,
        }
        self._vehicle.send(dialect.MAVLink_param_value_message, fields)

    def _refuse(self, message: Any, error: int, index: int) -> None:
        fields = {
            **addressed_to_sender(message),
            "param_id": message.param_id,
            "param_index": index,
            "error": error,
        }
        self._vehicle.send(dialect.MAVLink_param_error_message, fields)
