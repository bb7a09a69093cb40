"""What the vehicle has not: missions, files, other modes. Each request is refused at once."""

import math
import time
from typing import Any

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.commands.vehicle_access import VehicleAccess
from ftc_jsb.mavlink.link.message_fields import addressed_to_sender

SAY_AGAIN = 10.0  # [s]
FTP_NAK, FTP_UNKNOWN_COMMAND = 129, 7  # op code and error of MAVLink FTP


class UnsupportedServices:
    """Refuses each of these messages with one."""

    def __init__(self, vehicle: VehicleAccess) -> None:
        """Args: the vehicle that answers."""
        self._vehicle = vehicle
        self._said: dict[str, float] = {}  # when each message was last said not to be followed [s]

    def mission_request_list(self, message: Any) -> None:
        """There is no mission."""
        fields = {**addressed_to_sender(message), "count": 0, "mission_type": message.mission_type}
        self._vehicle.send(dialect.MAVLink_mission_count_message, fields)

    def mission_count(self, message: Any) -> None:
        """A mission cannot be uploaded."""
        self._mission_ack(message, dialect.MAV_MISSION_UNSUPPORTED)

    def mission_request(self, message: Any) -> None:
        """There is no such item."""
        self._mission_ack(message, dialect.MAV_MISSION_INVALID_SEQUENCE)

    def mission_set_current(self, message: Any) -> None:
        """There is no item to go to; the message has no type of mission."""
        fields = {**addressed_to_sender(message), "type": dialect.MAV_MISSION_INVALID_SEQUENCE}
        self._vehicle.send(dialect.MAVLink_mission_ack_message, fields)

    def mission_clear_all(self, message: Any) -> None:
        """It is empty already."""
        self._mission_ack(message, dialect.MAV_MISSION_ACCEPTED)

    def _mission_ack(self, message: Any, result: int) -> None:
        fields = {
            **addressed_to_sender(message),
            "type": result,
            "mission_type": message.mission_type,
        }
        self._vehicle.send(dialect.MAVLink_mission_ack_message, fields)

    def log_request_list(self, message: Any) -> None:
        """There are no logs on board."""
        fields = {"id": 0, "num_logs": 0, "last_log_num": 0, "time_utc": 0, "size": 0}
        self._vehicle.send(dialect.MAVLink_log_entry_message, fields)

    def log_request_data(self, message: Any) -> None:
        """No bytes of a log."""
        fields = {"id": message.id, "ofs": message.ofs, "count": 0, "data": [0] * 90}
        self._vehicle.send(dialect.MAVLink_log_data_message, fields)

    def not_followed(self, message: Any) -> None:
        """A stream of commands that has no acknowledgement: said once in a while."""
        name, now = message.get_type(), time.monotonic()
        if now >= self._said.get(name, -math.inf) + SAY_AGAIN:
            self._said[name] = now
            text = f"refused: {name.removeprefix('SET_')[:28]}: not followed"
            self._vehicle.send_text(dialect.MAV_SEVERITY_NOTICE, text)

    def file_transfer_protocol(self, message: Any) -> None:
        """There are no files: a NAK to what was asked, at once."""
        sequence, asked = int.from_bytes(bytes(message.payload[:2]), "little"), message.payload[3]
        payload = [0] * 251
        payload[:2] = ((sequence + 1) % 2**16).to_bytes(2, "little")
        payload[2] = message.payload[2]  # session
        payload[3:6] = FTP_NAK, 1, asked
        payload[12] = FTP_UNKNOWN_COMMAND
        self._vehicle.send(
            dialect.MAVLink_file_transfer_protocol_message,
            {**addressed_to_sender(message), "payload": payload},
        )

    def set_mode(self, message: Any) -> None:
        """There is one mode; a ground station sees it in the heartbeat."""
        self._vehicle.send_text(dialect.MAV_SEVERITY_NOTICE, "refused: there is one mode")
