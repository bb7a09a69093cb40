"""The vehicle: a thread beside the flight that sends what is flown and acts on what stations ask.

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

from ftc_jsb.mavlink.commands.message_dispatch import MessageDispatcher
from ftc_jsb.mavlink.commands.parameters import Parameters
from ftc_jsb.mavlink.link.budget import Budget
from ftc_jsb.mavlink.link.encoder import Encoder
from ftc_jsb.mavlink.link.endpoint import Endpoint
from ftc_jsb.mavlink.link.receiver import Receiver
from ftc_jsb.mavlink.link.telemetry_log import TelemetryLog
from ftc_jsb.mavlink.link.transport import Transport, open_transport
from ftc_jsb.mavlink.link.vehicle_link import Link, LinkStatistics
from ftc_jsb.mavlink.telemetry.flight_events import LONGEST_TEXT, FlightEvents
from ftc_jsb.mavlink.telemetry.message_streams import Station, StreamSchedule, message_fields
from ftc_jsb.mavlink.telemetry.snapshot import LinkHealth, Phase, Snapshot, SnapshotBuilder
from ftc_jsb.recording.commands import Command
from ftc_jsb.recording.flight import Flight
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.command_source import CommandQueue
from ftc_jsb.simulation.pacing import Pacer

RECEIVE_TIME = 0.002  # [s] that the thread receives at a time ...
FLOOD_REST = 0.008  # [s] ... before it rests from a flood: a fifth of a core at most
EVENT_INTERVAL = 0.1  # [s] between searches for events
MOST_SENT = 2000.0  # [1/s] messages: what stations may ask for as streams, and answers as many
LONGEST_SLEEP = 0.05  # [s] of the thread


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
        self.schedule = StreamSchedule()
        self.station: Station = (0, 0)
        self.leaves_after_flight = False
        self._queue, self._link, self._log, self._pacer = queue, link, log, pacer
        self._encoder = Encoder(link.system, link.key)
        self._receiver = Receiver(link.key)
        self._snapshots = SnapshotBuilder(scenario)
        self._selector = selectors.DefaultSelector()
        self._transport: Transport | None = None
        if link.endpoint is not None:
            try:
                self._transport = open_transport(link.endpoint, self._selector)
            except BaseException:
                self._selector.close()
                raise
        self._dispatcher = MessageDispatcher(self, link, log)
        self._flown: tuple[npt.NDArray[Any], int] | None = None  # recording and row
        self._end_phase: Phase | None = None
        self._texts: deque[tuple[int, str]] = deque()  # severity and text, to be sent
        self._events = FlightEvents(scenario)
        self._searched: tuple[npt.NDArray[Any] | None, int, float] = (None, 0, 0.0)
        self._last: Snapshot | None = None
        self._last_key: tuple[object, ...] = ()
        self._sent = self._over_budget = 0
        self._budget = Budget(MOST_SENT)
        self._errors: list[str] = []
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._run, name="mavlink", daemon=True)
        self._thread.start()

    # --- from the flight's thread --------------------------------------------------------------

    @property
    def endpoint(self) -> Endpoint | None:
        """Where the vehicle is; the port is the one that it has, where it was to be any."""
        return self._transport.endpoint if self._transport is not None else None

    def __call__(self, record: npt.NDArray[Any], i: int) -> None:
        """Row `i` has been flown."""
        self._flown = (record, i)

    def begin_again(self) -> None:
        """Another flight of the scenario begins."""
        self._flown = self._end_phase = None
        self.parameters.restart(self.scenario.loop)
        self._dispatcher.restart()

    def end_flight(self, flight: Flight) -> None:
        """The flight is over; the vehicle stays and says so."""
        status, reason = flight.outcome.status, flight.outcome.reason
        if status == "complete":
            self._texts.append((dialect.MAV_SEVERITY_NOTICE, "flight complete"))
        elif status != "ended":
            self._texts.append((dialect.MAV_SEVERITY_CRITICAL, f"{status}: {reason}"))
        self._end_phase = Phase.OVER if status in ("complete", "ended") else Phase.LOST

    def announce(self, text: str) -> None:
        """Tell the ground stations something that stands in no row."""
        self._texts.append((dialect.MAV_SEVERITY_NOTICE, text))

    def close(self) -> LinkStatistics:
        """Leave the link; what has gone over it."""
        self._closing.set()
        self._thread.join()
        if self._transport is not None:
            self._transport.close()
        self._selector.close()
        return self.statistics()

    def core_seconds(self) -> float:
        """Time [s] that the vehicle's thread has kept a core busy."""
        clock = time.pthread_getcpuclockid(self._thread.ident or 0)
        return time.clock_gettime(clock)

    def statistics(self) -> LinkStatistics:
        """What has gone over the link so far."""
        return LinkStatistics(
            self._sent,
            (self._transport.unsent if self._transport else 0) + self._over_budget,
            self._receiver.received,
            self._receiver.refused,
            self._dispatcher.ignored,
            self._encoder.clamped,
            tuple(self._errors),
        )

    # --- for the message handlers, in the vehicle's thread ------------------------------------

    def snapshot(self) -> Snapshot:
        """The vehicle now."""
        flown, phase = self._flown, self._phase()
        key = (flown and id(flown[0]), flown and flown[1], phase)
        if self._last is None or key != self._last_key:
            if flown is None:
                self._last = self._snapshots.waiting(time.time(), self._health())
            else:
                self._last = self._snapshots.at(*flown, phase, time.time(), self._health())
            self._last_key = key
        critical = self._events.critical
        return self._last._replace(unix=time.time(), health=self._health(), critical=critical)

    def send(self, message: type[Any], fields: Mapping[str, Any]) -> None:
        """Send a message to every ground station, and log it; beyond the budget it is counted and gone."""
        if not self._budget.take() and message is not dialect.MAVLink_heartbeat_message:
            self._over_budget += 1
            return
        frame = self._encoder.frame(message, fields)
        self._sent += 1
        if self._transport is not None:
            self._transport.send(frame)
        if self._log is not None:
            self._log.write(frame, time.time())

    def send_text(self, severity: int, text: str) -> None:
        """Send a STATUSTEXT."""
        fields = {"severity": severity, "text": text[:LONGEST_TEXT]}
        self.send(dialect.MAVLink_statustext_message, fields)

    def queue_command(self, command: Command) -> None:
        """Have a command applied at the next step boundary."""
        self._queue.put(command)

    def _phase(self) -> Phase:
        if self._end_phase is not None:
            return self._end_phase
        if self._flown is None:
            return Phase.WAITING
        return Phase.PAUSED if self._queue.paused else Phase.FLYING

    def _health(self) -> LinkHealth:
        load, overruns = (self._pacer.load, self._pacer.overruns) if self._pacer else (0.0, 0)
        unsent = self._transport.unsent if self._transport else 0
        return LinkHealth(load, overruns, self._encoder.clamped, unsent, self._receiver.refused)

    # --- the thread ----------------------------------------------------------------------------

    def _run(self) -> None:
        rests_until = 0.0
        while not self._closing.is_set():
            now = time.monotonic()
            pause = min(max(self.schedule.next() - now, 0.0), LONGEST_SLEEP)
            if now < rests_until or not self._selector.get_map():
                time.sleep(min(pause, max(rests_until - now, 0.0)) if now < rests_until else pause)
            elif self._selector.select(pause):
                limit = time.monotonic() + RECEIVE_TIME
                self._guarded(self._receive_messages, limit)
                if time.monotonic() >= limit:
                    rests_until = time.monotonic() + FLOOD_REST
            self._guarded(self._send_due)
        self._guarded(self._report_events)

    def _guarded(self, work: Callable[..., None], *arguments: Any) -> None:
        """A mistake of this program costs a message, not the vehicle; it is reported at the end."""
        try:
            work(*arguments)
        except Exception as error:
            if len(self._errors) < 10:
                self._errors.append(f"{type(error).__name__}: {error}")

    def _send_due(self) -> None:
        """Send what is due, and what has happened."""
        for stream in self.schedule.due():
            for fields in message_fields(stream, self.snapshot()):
                self.send(stream.message, fields)
        self._report_events()
        while self._texts:
            self.send_text(*self._texts.popleft())

    def _report_events(self) -> None:
        """Send a text for each event in the rows since the last search."""
        flown, now = self._flown, time.monotonic()
        record, row, when = self._searched
        if flown is None or (now < when + EVENT_INTERVAL and not self._closing.is_set()):
            return
        if flown[0] is not record:
            self._events, row = FlightEvents(self.scenario), 0
        for event in self._events.find(flown[0], row, flown[1] + 1):
            self.send_text(event.severity, event.text)
        self._searched = (flown[0], flown[1] + 1, now)

    def _receive_messages(self, limit: float) -> None:
        """Act on what has come, until the clock's time `limit` [s]."""
        assert self._transport is not None
        for peer, data, continues in self._transport.receive(limit):
            messages = self._receiver.messages(peer, data, continues)
            if messages:
                self._transport.accept_peer(peer)
            for message in messages:
                self._guarded(self._dispatcher.dispatch, message)
        for peer in self._transport.disconnected():
            self._receiver.forget(peer)
