"""Where a flight gets its commands from: a queue that another thread fills, or a recording.

Commands are drained at step boundaries, whether they come from a ground station (`CommandQueue`) or
from a recording (`RecordedCommands`).
"""

import threading
import time
from collections import deque
from collections.abc import Iterator, Sequence
from typing import Protocol

from ftc_jsb.recording.commands import Applied, Command, Pause, Resume


class CommandSource(Protocol):
    """Where `fly` gets commands from."""

    def next_row(self, row: int) -> int:
        """The first row after `row` before which a command may come."""

    def take(self, row: int) -> Iterator[Command]:
        """Commands to be applied before `row` is flown."""


class CommandQueue:
    """Commands from another thread. Between `Pause` and `Resume` the flight waits here."""

    def __init__(self) -> None:
        """An empty queue."""
        self._waiting: deque[Command] = deque()
        self._changed = threading.Condition()
        self.held = 0.0  # [s] of wall time that the flight has been paused, all in all
        self.paused = False

    def put(self, command: Command) -> None:
        """Have `command` applied at the next step boundary."""
        with self._changed:
            self._waiting.append(command)
            self._changed.notify()

    def next_row(self, row: int) -> int:
        """Any row."""
        return row + 1

    def take(self, row: int) -> Iterator[Command]:
        """What is waiting; after a `Pause` also what comes, up to a `Resume`."""
        self.paused = False
        while self._waiting or self.paused:
            if not self._waiting:
                self._hold()
            command = self._waiting.popleft()
            if isinstance(command, Pause | Resume):
                self.paused = isinstance(command, Pause)
            yield command

    def wait(self, timeout: float | None) -> Command | None:
        """The next command, for which it waits; None if none comes in `timeout` seconds."""
        with self._changed:
            self._changed.wait_for(lambda: bool(self._waiting), timeout)
            return self._waiting.popleft() if self._waiting else None

    def clear(self) -> None:
        """Forget what has not been applied: it was meant for a flight that is over."""
        self._waiting.clear()
        self.paused = False

    def _hold(self) -> None:
        since = time.perf_counter()
        with self._changed:
            self._changed.wait_for(lambda: bool(self._waiting))
        self.held += time.perf_counter() - since


class RecordedCommands:
    """The commands of a recording."""

    def __init__(self, applied: Sequence[Applied]) -> None:
        """Args: in the order of their rows."""
        self._applied = tuple(applied)

    def next_row(self, row: int) -> int:
        """The row of the next command; a row beyond any flight if there is none."""
        return next((entry.row for entry in self._applied if entry.row > row), 2**62)

    def take(self, row: int) -> Iterator[Command]:
        """Those that were applied before `row`."""
        return (entry.command for entry in self._applied if entry.row == row)
