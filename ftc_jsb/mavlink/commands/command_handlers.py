"""Handlers of commands (MAV_CMD): how each is gated, queued for the flight and acknowledged."""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from enum import IntEnum
from typing import Any, NamedTuple

from pydantic import ValidationError
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.commands.vehicle_access import VehicleAccess
from ftc_jsb.recording.commands import Command

Params = tuple[float, ...]  # the seven of a command; nan where it has none


class Result(IntEnum):
    """MAV_RESULT."""

    ACCEPTED = dialect.MAV_RESULT_ACCEPTED
    REJECTED = dialect.MAV_RESULT_TEMPORARILY_REJECTED
    DENIED = dialect.MAV_RESULT_DENIED
    UNSUPPORTED = dialect.MAV_RESULT_UNSUPPORTED


class Acknowledgement(NamedTuple):
    """The result of a command, and why, where that is not plain."""

    result: Result
    reason: str = ""


Handlers = dict[int, Callable[[Params], Acknowledgement]]  # by MAV_CMD


class CommandHandlers(ABC):
    """Handlers of the commands of one purpose."""

    def __init__(self, vehicle: VehicleAccess) -> None:
        """Args: the vehicle that is commanded."""
        self._vehicle = vehicle

    @abstractmethod
    def handlers(self) -> Handlers:
        """What acts on each command, and says how it is acknowledged."""

    def _in_flight(self) -> bool:
        return self._vehicle.snapshot().in_flight

    def _queue(self, make: Callable[[], Command], text: str = "") -> Acknowledgement:
        """Queue a command for the flight, if there is one and the command is in its range.

        Args:
            make: builds the command, whose numbers are checked by that.
            text: for ground stations, of a command that is accepted.
        """
        if not self._in_flight():
            return Acknowledgement(Result.REJECTED, "refused: not in flight")
        try:
            command = make()
        except ValidationError as error:
            problem = error.errors(include_url=False)[0]
            return Acknowledgement(Result.DENIED, _bound(problem))
        self._vehicle.queue_command(command)
        return Acknowledgement(Result.ACCEPTED, text)


_AT = {"ge": "at least", "gt": "above", "le": "at most", "lt": "below"}


def _bound(problem: Mapping[str, Any]) -> str:
    """Which number of a command is refused, and its bound in SI and rad."""
    bounds = problem.get("ctx", {})
    said = [f"{words} {bounds[key]:.4g}" for key, words in _AT.items() if key in bounds]
    return f"{problem['loc'][-1]} {said[0] if said else 'is no number'}"


def whole_number(value: float) -> int:
    """A parameter that names something; -1 where it is no whole number, 0 where it was left out."""
    if math.isnan(value):
        return 0
    return int(value) if math.isfinite(value) and value == int(value) else -1
