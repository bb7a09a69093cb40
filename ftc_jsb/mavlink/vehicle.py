"""The vehicle: a thread beside the flight that looks at the rows that are flown, tells and answers.

The flight only notes how far it is (`Vehicle.__call__`). A row that has been flown is never changed
again, so the thread reads the recording itself; nothing is locked, and nothing here can hold the
flight up.
"""

import selectors
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from typing import Any

import numpy.typing as npt
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.commands.dispatch import Conversation
from ftc_jsb.mavlink.commands.parameters import Parameters
from ftc_jsb.mavlink.link.encoder import Encoder
from ftc_jsb.mavlink.link.link import Link, Tally
from ftc_jsb.mavlink.link.receiver import Receiver
from ftc_jsb.mavlink.link.telemetry_log import TelemetryLog
from ftc_jsb.mavlink.link.transport import Transport, transport
from ftc_jsb.mavlink.telemetry.snapshot import Counters, Observatory, Phase, Snapshot
from ftc_jsb.mavlink.telemetry.status_texts import LONGEST, Watch
from ftc_jsb.mavlink.telemetry.streams import Timetable, contents
from ftc_jsb.recording.commands import Command
from ftc_jsb.recording.flight import Flight
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.command_source import CommandQueue
from ftc_jsb.simulation.pacing import Pacer

LISTEN = 0.002  # [s] that the thread listens at a time ...
REST = 0.008  # [s] ... before it rests from a flood: a fifth of a core at most
LOOK = 0.1  # [s] between looks for events
IDLE = 0.05  # [s] that the thread sleeps at most


class Vehicle:
    """An observer of flights, and a MAVLink vehicle in a thread of its own."""

    def __init__(
        self,
        scenario: Scenario,
        queue: CommandQueue,
        link: Link,
        log: TelemetryLog | None = None,
        pacer: Pacer | None = None,
    ) -> None:
        """Opens the link; the vehicle is there from now on.

        Raises:
            LinkError: the endpoint cannot be used.
        """
        self.scenario = scenario
        self.parameters = Parameters(scenario.loop)
        self.timetable = Timetable()
        self.leaves = False
        self._queue, self._link, self._log, self._pacer = queue, link, log, pacer
        self._encoder = Encoder(link.system, link.key)
        self._receiver = Receiver(link.key)
        self._observatory = Observatory(scenario)
        self._selector = selectors.DefaultSelector()
        self._transport: Transport | None = None
        if link.endpoint is not None:
            self._transport = transport(link.endpoint, self._selector)
        self._conversation = Conversation(self, link, log)
        self._flown: tuple[npt.NDArray[Any], int] | None = None  # recording and row
        self._ended: Phase | None = None
        self._texts: deque[tuple[int, str]] = deque()
        self._watch = Watch(scenario)
        self._looked: tuple[npt.NDArray[Any] | None, int, float] = (None, 0, 0.0)
        self._last: Snapshot | None = None
        self._last_of: tuple[object, ...] = ()
        self._sent = 0
        self._errors: list[str] = []
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._run, name="mavlink", daemon=True)
        self._thread.start()

    # --- from the flight's thread --------------------------------------------------------------

    def __call__(self, record: npt.NDArray[Any], i: int) -> None:
        """Row `i` has been flown."""
        self._flown = (record, i)

    def begins(self) -> None:
        """Another flight of the scenario begins."""
        self._flown = self._ended = None
        self.parameters.restart(self.scenario.loop)
        self._conversation.restart()

    def ended(self, flight: Flight) -> None:
        """The flight is over; the vehicle stays and says so."""
        status, reason = flight.outcome.status, flight.outcome.reason
        if status == "complete":
            self._texts.append((dialect.MAV_SEVERITY_NOTICE, "flight complete"))
        elif status != "ended":
            self._texts.append((dialect.MAV_SEVERITY_CRITICAL, f"{status}: {reason}"))
        self._ended = Phase.OVER if status in ("complete", "ended") else Phase.LOST

    def close(self) -> Tally:
        """Leave the link; what has gone over it."""
        self._closing.set()
        self._thread.join()
        if self._transport is not None:
            self._transport.close()
        self._selector.close()
        return self.tally()

    def core_seconds(self) -> float:
        """Time [s] that the vehicle's thread has kept a core busy."""
        clock = time.pthread_getcpuclockid(self._thread.ident or 0)
        return time.clock_gettime(clock)

    def tally(self) -> Tally:
        """What has gone over the link so far."""
        return Tally(
            self._sent,
            self._transport.unsent if self._transport else 0,
            self._receiver.received,
            self._receiver.refused,
            self._conversation.ignored,
            self._encoder.clamped,
            tuple(self._errors),
        )

    # --- the desk of the answers, in the vehicle's thread --------------------------------------

    def snapshot(self) -> Snapshot:
        """The vehicle now."""
        flown, phase = self._flown, self._phase()
        key = (flown and id(flown[0]), flown and flown[1], phase)
        if self._last is None or key != self._last_of:
            if flown is None:
                self._last = self._observatory.waiting(time.time(), self._counters())
            else:
                self._last = self._observatory.at(*flown, phase, time.time(), self._counters())
            self._last_of = key
        return self._last._replace(unix=time.time(), counters=self._counters())

    def send(self, message: type[Any], fields: Mapping[str, Any]) -> None:
        """Send a message to every ground station, and log it."""
        frame = self._encoder.frame(message, fields)
        self._sent += 1
        if self._transport is not None:
            self._transport.send(frame)
        if self._log is not None:
            self._log.write(frame, time.time())

    def say(self, severity: int, text: str) -> None:
        """Send a STATUSTEXT."""
        fields = {"severity": severity, "text": text[:LONGEST]}
        self.send(dialect.MAVLink_statustext_message, fields)

    def give(self, command: Command) -> None:
        """Have a command applied at the next step boundary."""
        self._queue.put(command)

    def _phase(self) -> Phase:
        if self._ended is not None:
            return self._ended
        if self._flown is None:
            return Phase.WAITING
        return Phase.PAUSED if self._queue.paused else Phase.FLYING

    def _counters(self) -> Counters:
        load, overruns = (self._pacer.load, self._pacer.overruns) if self._pacer else (0.0, 0)
        unsent = self._transport.unsent if self._transport else 0
        return Counters(load, overruns, self._encoder.clamped, unsent, self._receiver.refused)

    # --- the thread ----------------------------------------------------------------------------

    def _run(self) -> None:
        rests_until = 0.0
        while not self._closing.is_set():
            now = time.monotonic()
            pause = min(max(self.timetable.next() - now, 0.0), IDLE)
            if now < rests_until or not self._selector.get_map():
                time.sleep(min(pause, max(rests_until - now, 0.0)) if now < rests_until else pause)
            elif self._selector.select(pause):
                limit = time.monotonic() + LISTEN
                self._guarded(self._listen, limit)
                if time.monotonic() >= limit:
                    rests_until = time.monotonic() + REST
            self._guarded(self._tell)
        self._guarded(self._look)

    def _guarded(self, work: Callable[..., None], *arguments: Any) -> None:
        """A mistake of this program costs a message, not the vehicle; it is told at the end."""
        try:
            work(*arguments)
        except Exception as error:
            if len(self._errors) < 10:
                self._errors.append(f"{type(error).__name__}: {error}")

    def _tell(self) -> None:
        """Send what is due."""
        for stream in self.timetable.due():
            for fields in contents(stream, self.snapshot()):
                self.send(stream.message, fields)
        self._look()
        while self._texts:
            self.say(*self._texts.popleft())

    def _look(self) -> None:
        """Tell what has happened in the rows since the last look."""
        flown, now = self._flown, time.monotonic()
        record, row, when = self._looked
        if flown is None or (now < when + LOOK and not self._closing.is_set()):
            return
        if flown[0] is not record:
            self._watch, row = Watch(self.scenario), 0
        for event in self._watch.news(flown[0], row, flown[1] + 1):
            self.say(event.severity, event.text)
        self._looked = (flown[0], flown[1] + 1, now)

    def _listen(self, limit: float) -> None:
        assert self._transport is not None
        for peer, data, continues in self._transport.receive(limit):
            messages = self._receiver.messages(peer, data, continues)
            if messages:
                self._transport.welcome(peer)
            for message in messages:
                self._guarded(self._conversation.hear, message)
        for peer in self._transport.gone():
            self._receiver.forget(peer)
