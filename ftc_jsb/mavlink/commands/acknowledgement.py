"""The result of a command, and how one is given to the flight."""

import math
from collections.abc import Callable
from typing import NamedTuple

from pydantic import ValidationError
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.commands.vehicle_access import Desk
from ftc_jsb.mavlink.telemetry.status import IN_THE_AIR
from ftc_jsb.recording.commands import Command

ACCEPTED = dialect.MAV_RESULT_ACCEPTED
DENIED = dialect.MAV_RESULT_DENIED
UNSUPPORTED = dialect.MAV_RESULT_UNSUPPORTED
REJECTED = dialect.MAV_RESULT_TEMPORARILY_REJECTED

Params = tuple[float, ...]  # the seven of a command; nan where it has none


class Reply(NamedTuple):
    """The result of a command, and why, where that is not plain."""

    result: int
    reason: str = ""


Handlers = dict[int, Callable[[Params], Reply]]  # by MAV_CMD


def given(desk: Desk, make: Callable[[], Command], text: str = "") -> Reply:
    """Give a command to the flight, if there is one and the command is in its range."""
    if desk.snapshot().phase not in IN_THE_AIR:
        return Reply(REJECTED, "refused: not in flight")
    try:
        command = make()
    except ValidationError as error:
        problem = error.errors(include_url=False)[0]
        return Reply(DENIED, f"refused: {problem['loc'][-1]}: {problem['msg']}")
    desk.give(command)
    return Reply(ACCEPTED, text)


def whole(value: float) -> int:
    """A number that names something; -1 where it is none, 0 where it was left out."""
    if math.isnan(value):
        return 0
    return int(value) if math.isfinite(value) and value == int(value) else -1
