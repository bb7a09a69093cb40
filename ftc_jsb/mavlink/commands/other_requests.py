"""Answers to what ground stations ask besides commands and parameters: missions, files, clocks."""

import time
from typing import Any

from pymavlink.dialects.v20 import common as dialect

import ftc_jsb
from ftc_jsb.mavlink.commands.vehicle_access import Desk

Fields = dict[str, Any]

FTP_NAK, FTP_UNKNOWN_COMMAND = 129, 7
CAPABILITIES = (
    dialect.MAV_PROTOCOL_CAPABILITY_PARAM_FLOAT
    | dialect.MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_C_CAST
    | dialect.MAV_PROTOCOL_CAPABILITY_COMMAND_INT
    | dialect.MAV_PROTOCOL_CAPABILITY_FLIGHT_TERMINATION
    | dialect.MAV_PROTOCOL_CAPABILITY_MAVLINK2
)


def autopilot_version() -> Fields:
    """AUTOPILOT_VERSION: capabilities, and the version of this program as 0xMMmmpp00."""
    numbers = [int(part) for part in ftc_jsb.__version__.split(".")[:3] if part.isdecimal()]
    major, minor, patch = (*numbers, 0, 0, 0)[:3]
    version = major << 24 | minor << 16 | patch << 8
    return {
        "capabilities": CAPABILITIES,
        "flight_sw_version": version,
        "flight_custom_version": [0] * 8,
        "middleware_custom_version": [0] * 8,
        "os_custom_version": [0] * 8,
        "uid2": [0] * 18,
    }


class Answers:
    """Answers each of a few messages with one."""

    def __init__(self, desk: Desk) -> None:
        """Args: the vehicle."""
        self._desk = desk

    def mission_request_list(self, message: Any) -> None:
        """There is no mission."""
        fields = {**_to(message), "count": 0, "mission_type": message.mission_type}
        self._desk.send(dialect.MAVLink_mission_count_message, fields)

    def mission_count(self, message: Any) -> None:
        """A mission cannot be uploaded."""
        self._mission_ack(message, dialect.MAV_MISSION_UNSUPPORTED)

    def mission_request(self, message: Any) -> None:
        """There is no such item."""
        self._mission_ack(message, dialect.MAV_MISSION_INVALID_SEQUENCE)

    def mission_clear_all(self, message: Any) -> None:
        """It is empty already."""
        self._mission_ack(message, dialect.MAV_MISSION_ACCEPTED)

    def _mission_ack(self, message: Any, result: int) -> None:
        fields = {**_to(message), "type": result, "mission_type": message.mission_type}
        self._desk.send(dialect.MAVLink_mission_ack_message, fields)

    def file_transfer_protocol(self, message: Any) -> None:
        """There are no files: a NAK to what was asked, at once."""
        sequence, asked = int.from_bytes(bytes(message.payload[:2]), "little"), message.payload[3]
        payload = [0] * 251
        payload[:2] = ((sequence + 1) % 2**16).to_bytes(2, "little")
        payload[2] = message.payload[2]  # session
        payload[3:6] = FTP_NAK, 1, asked
        payload[12] = FTP_UNKNOWN_COMMAND
        self._desk.send(
            dialect.MAVLink_file_transfer_protocol_message, {**_to(message), "payload": payload}
        )

    def timesync(self, message: Any) -> None:
        """A request is answered with our clock [ns]; an answer is not asked for."""
        if message.tc1 == 0:
            now = {"tc1": time.monotonic_ns(), "ts1": message.ts1}
            self._desk.send(dialect.MAVLink_timesync_message, now)

    def ping(self, message: Any) -> None:
        """Sent back to who asked."""
        if message.target_system == 0:
            fields = {"time_usec": message.time_usec, "seq": message.seq, **_to(message)}
            self._desk.send(dialect.MAVLink_ping_message, fields)

    def request_data_stream(self, message: Any) -> None:
        """The rate of a group of messages."""
        rate = float(message.req_message_rate) if message.start_stop else 0.0
        self._desk.timetable.set_group(message.req_stream_id, rate)

    def set_mode(self, message: Any) -> None:
        """There is one mode; a ground station sees it in the heartbeat."""
        self._desk.say(dialect.MAV_SEVERITY_NOTICE, "refused: there is one mode")


def _to(message: Any) -> Fields:
    """Addressed to who sent `message`."""
    return {
        "target_system": message.get_srcSystem(),
        "target_component": message.get_srcComponent(),
    }
