"""How many messages a link carries: so many a second, and in a burst as many as in one second."""

import time
from collections.abc import Callable


class Budget:
    """Messages that may still go; they come again with time."""

    def __init__(self, rate: float, clock: Callable[[], float] = time.monotonic) -> None:
        """Args: messages a second; gives the time [s]."""
        self._rate, self._clock = rate, clock
        self._left, self._at = rate, clock()

    def take(self) -> bool:
        """Whether one more message may go now; it is counted if so."""
        now = self._clock()
        self._left = min(self._left + (now - self._at) * self._rate, self._rate)
        self._at = now
        if self._left < 1.0:
            return False
        self._left -= 1.0
        return True
