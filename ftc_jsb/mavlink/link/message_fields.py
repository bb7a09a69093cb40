"""Fields of MAVLink messages: their values by name, what stands for unknown, and whom they are for."""

from typing import Any

Fields = dict[str, Any]  # by name, in units of the message

UNKNOWN_8, UNKNOWN_16 = 2**8 - 1, 2**16 - 1  # of fields of so many bits


def addressed_to_sender(message: Any) -> Fields:
    """Target system and component of an answer to `message`."""
    return {
        "target_system": message.get_srcSystem(),
        "target_component": message.get_srcComponent(),
    }
