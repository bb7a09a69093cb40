"""Real time: an observer that holds a flight back to its deadlines. It never changes the flight."""

import time
from typing import Any

import numpy.typing as npt

GIVE_UP = 1.0  # [s] late: a suspended computer; deadlines start anew instead of a race after them


class Pacer:
    """An observer that returns when the next sample is due: start + time / factor, absolute."""

    def __init__(self, rate: float, factor: float) -> None:
        """Args: samples a second of flight; seconds of flight a second."""
        self._period = 1.0 / (rate * factor)
        self._record: npt.NDArray[Any] | None = None
        self._first = 0.0

    def __call__(self, record: npt.NDArray[Any], i: int) -> None:
        """Wait until sample i + 1 is due."""
        now = time.perf_counter()
        if record is not self._record:  # a flight begins
            self._record, self._first = record, now - i * self._period
        wait = self._first + (i + 1) * self._period - now
        if wait > 0.0:
            time.sleep(wait)
        elif wait < -GIVE_UP:
            self._first -= wait
