"""Time as the simulator has it: what each line says of it, in simulation time alone.

The step between two lines is what the frames between them took. While time stands still lines repeat their
frame; a reset begins again with a smaller one.
"""

from enum import Enum
from typing import NamedTuple

RESET_BACK = 0.5  # [s] that time must go back to be a reset: less is disorder on the way
PAUSED = 0.3  # [s] of the clock without a new frame


class Arrival(Enum):
    """What a line is to the flight."""

    FIRST = "first"
    NEXT = "next"
    REPEATED = "repeated"
    SURPLUS = "surplus"
    DISORDERED = "disordered"
    RESET = "reset"


class Moment(NamedTuple):
    """When a line was: frames flown, and simulation time [s]."""

    frame: int
    time: float


def arrival(last: Moment | None, now: Moment, least: float) -> Arrival:
    """What the line of a moment is after the last one that was taken.

    Args:
        last: None before the first.
        now: of the line.
        least: simulation time [s] between two that are taken.
    """
    if last is None:
        return Arrival.FIRST
    if now.time < last.time - RESET_BACK:
        return Arrival.RESET
    if now.frame == last.frame:
        return Arrival.REPEATED
    if now.frame < last.frame or now.time <= last.time:
        return Arrival.DISORDERED
    return Arrival.SURPLUS if now.time - last.time < least else Arrival.NEXT


class Clock:
    """Whether the simulator's time passes, seen by the clock."""

    def __init__(self) -> None:
        """Nothing has come yet."""
        self._moved = self._heard = -1e9

    def heard(self, wall: float, moved: bool) -> None:
        """A line has come at the clock's time `wall` [s], with a new frame or the old one."""
        self._heard = wall
        if moved:
            self._moved = wall

    def paused(self, wall: float) -> bool:
        """Lines come, and time stands still."""
        return wall - self._moved > PAUSED >= wall - self._heard

    def silent(self, wall: float, limit: float) -> bool:
        """Nothing has come for `limit` seconds."""
        return wall - self._heard > limit
