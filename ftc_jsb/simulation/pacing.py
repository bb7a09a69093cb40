"""Real time: a flight held back to its deadlines, and how well that went. It never changes the flight."""

import time
from array import array
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.simulation.command_source import CommandQueue

GIVE_UP = 1.0  # [s] late: a suspended computer; deadlines start anew instead of a race after them


class PacingError(NamedTuple):
    """How late samples began after their deadlines [s], and how many began later than one sample."""

    median: float
    p99: float
    largest: float
    samples: int
    overruns: int


class Pacer:
    """An observer that returns when the next sample is due: start + time / factor, absolute."""

    def __init__(self, rate: float, factor: float, queue: CommandQueue | None = None) -> None:
        """Args: samples a second of flight; seconds of flight a second; whose pauses move deadlines."""
        self._period = 1.0 / (rate * factor)
        self._queue = queue
        self._record: npt.NDArray[Any] | None = None
        self._first = 0.0
        self._held = 0.0
        self._late = array("f")
        self.overruns = 0
        self.load = 0.0  # share of the last period that the flight took

    def __call__(self, record: npt.NDArray[Any], i: int) -> None:
        """Wait until sample i + 1 is due."""
        now = time.perf_counter()
        if record is not self._record:  # a flight begins
            self._record, self._first = record, now - i * self._period
            self._held = self._queue.held if self._queue else 0.0
        held = self._queue.held - self._held if self._queue else 0.0
        due = self._first + (i + 1) * self._period + held
        self.load = 1.0 - (due - now) / self._period
        if due > now:
            time.sleep(due - now)
            now = time.perf_counter()
        late = now - due
        self._late.append(late)
        if late > self._period:
            self.overruns += 1
        if late > GIVE_UP:
            self._first += late

    def error(self) -> PacingError:
        """Of all samples so far."""
        late = np.array(self._late) if self._late else np.zeros(1)
        median, p99 = np.percentile(late, [50.0, 99.0])
        largest = float(late.max())
        return PacingError(float(median), float(p99), largest, len(self._late), self.overruns)
