"""The exchange with a simulator: lines that count come out in order, commands go in with their numbers."""

import time
from collections.abc import Callable
from typing import NamedTuple

from ftc_jsb.errors import LinkError
from ftc_jsb.flightgear.lines import Counts, line_of, numbers_of
from ftc_jsb.flightgear.link import SimulatorLink
from ftc_jsb.flightgear.outside_aircraft import LineFields, Numbers
from ftc_jsb.flightgear.timing import Arrival, Clock, Moment, arrival
from ftc_jsb.six_dof.exchange.fields import COMMANDED

HEARD = 1.0  # [s] of the clock that `receive` waits at most
_COMMANDED = tuple(field.name for field in COMMANDED)


class Received(NamedTuple):
    """A line that counts."""

    arrival: Arrival  # FIRST, NEXT or RESET
    numbers: Numbers
    moment: Moment


class Exchange:
    """Lines of one aircraft, over one link."""

    def __init__(
        self, link: SimulatorLink, fields: LineFields, gone: Callable[[], str] = lambda: ""
    ) -> None:
        """Args: where lines come and go; what they are made of; why the simulator is gone, "" if it is not."""
        self.fields, self.clock = fields, Clock()
        self._link, self._gone = link, gone
        self._last: Moment | None = None
        self._counts = dict.fromkeys(Counts._fields, 0)
        self._sequence = 0

    @property
    def counts(self) -> Counts:
        """What became of the lines that came."""
        return Counts(**self._counts)

    def check_alive(self, patience: float) -> None:
        """See that the simulator is there.

        Raises:
            LinkError: it has ended, or no line has come for `patience` seconds.
        """
        reason = self._gone()
        if not reason and self.clock.silent(time.monotonic(), patience):
            reason = f"no line came for {patience:g} s"
        if reason:
            raise LinkError(reason)

    def begin(self) -> None:
        """Whatever comes next is the first."""
        self._last = None

    def receive(self, timeout: float, least: float) -> list[Received]:
        """Lines that count, of those that have come.

        Args:
            timeout: for the first [s].
            least: simulation time between two [s].
        """
        found = []
        for line in self._link.receive(timeout):
            numbers = numbers_of(line, self.fields.count)
            if numbers is None:
                self._counts["malformed"] += 1
                continue
            received = self._sorted(numbers, least)
            if received is not None:
                found.append(received)
        return found

    def _sorted(self, numbers: Numbers, least: float) -> Received | None:
        value = self.fields.value
        now = Moment(round(value(numbers, "frame")), value(numbers, "time"))
        kind = arrival(self._last, now, least)
        self.clock.heard(time.monotonic(), kind is not Arrival.REPEATED)
        if kind in (Arrival.FIRST, Arrival.NEXT, Arrival.RESET):
            self._counts["taken"] += 1
            self._last = now
            return Received(kind, numbers, now)
        self._counts[kind.value] += 1
        return None

    def command(self, values: dict[str, float]) -> int:
        """Send a line of commands by their names, `sequence` apart; returns its number."""
        self._sequence += 1
        values = {**values, "sequence": self._sequence}
        self._link.send(line_of([values[name] for name in _COMMANDED]))
        return self._sequence

    def wait_in_the_air(self, patience: float) -> Numbers:
        """The first line of an aircraft that is trimmed and in the air: its inner loop flies.

        Args:
            patience: [s] of the clock.

        Raises:
            LinkError: none came; says what came instead.
        """
        until = time.monotonic() + patience
        seen = "no line"
        while time.monotonic() < until:
            self.begin()
            if self._gone():
                raise LinkError(self._gone())
            for received in self.receive(HEARD, 0.0):
                numbers = received.numbers
                if self.fields.value(numbers, "flying") > 0.5:
                    return numbers
                seen = "lines of an aircraft that is not yet in the air"
            if self.counts.malformed and not self.counts.taken:
                seen = f"{self.counts.malformed} lines that are not the exchange's"
        raise LinkError(
            f"no aircraft in the air after {patience:g} s: {seen} came to port {self._link.port}"
        )
