"""A live flight: paced, seen and commanded by ground stations, and what becomes of it afterwards."""

import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from ftc_jsb.atomic_file import atomic_file
from ftc_jsb.errors import LinkError
from ftc_jsb.interruption import interruptible
from ftc_jsb.mavlink.link.telemetry_log import TelemetryLog
from ftc_jsb.mavlink.link.vehicle_link import Link, LinkStatistics
from ftc_jsb.mavlink.telemetry.recording_to_tlog import write_tlog
from ftc_jsb.mavlink.vehicle import Vehicle
from ftc_jsb.recording.commands import End, Reset
from ftc_jsb.recording.flight import Flight
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.command_source import CommandQueue, CommandSource
from ftc_jsb.simulation.fly import Observer
from ftc_jsb.simulation.pacing import Pacer, PacingError

SWITCH_INTERVAL = 0.0005  # [s] that one thread may keep the other waiting


class LiveFlight:
    """A `Live` with a vehicle."""

    def __init__(self, vehicle: Vehicle, pacer: Pacer | None, queue: CommandQueue, linger: float):
        """Args: the parts; for how long [s] the vehicle stays after its flight."""
        self.note = ""  # for the user, before the flight
        self.commands = queue
        self.observers: Sequence[Observer] = (vehicle, pacer) if pacer else (vehicle,)
        self.pacer = pacer
        self.statistics: LinkStatistics | None = None
        self.vehicle = vehicle
        self._linger = linger

    def flies_again(self, flight: Flight) -> bool:
        """The vehicle stays, with its heartbeat, until the time is over, Ctrl-C or a command."""
        self.vehicle.end_flight(flight)
        if flight.commands and isinstance(flight.commands[-1].command, Reset):
            return self._again()
        if flight.outcome.status == "interrupted" or self.vehicle.leaves_after_flight:
            return False
        until = time.monotonic() + self._linger
        try:
            with interruptible():
                while (left := until - time.monotonic()) > 0.0:
                    command = self.commands.wait(min(left, 3600.0))
                    if isinstance(command, Reset):
                        return self._again()
                    if isinstance(command, End):
                        return False
        except KeyboardInterrupt:
            pass
        return False

    def announce(self, text: str) -> None:
        """As a STATUSTEXT."""
        self.vehicle.announce(text)

    def _again(self) -> bool:
        self.commands.clear()
        self.vehicle.begin_again()
        return True

    def summary(self) -> list[str]:
        """What went over the link, and how well time was kept; for the user."""
        lines = []
        if self.statistics is not None:
            s = self.statistics
            lines.append(
                f"link: {s.sent} frames sent ({s.unsent} not taken), {s.received} received "
                f"({s.ignored} ignored), {s.refused} refused, {s.clamped} values clamped"
            )
            lines += [f"link: internal error: {error}" for error in s.errors]
        if self.pacer is not None:
            lines.append(pacing_line(self.pacer.error()))
        return lines


class LogOnly:
    """A `Live` that leaves the flight alone and writes its log when it is over."""

    observers: Sequence[Observer] = ()
    commands: CommandSource | None = None

    def __init__(self, path: Path) -> None:
        """Args: of the log; that its folder can be written is seen now."""
        try:
            with tempfile.TemporaryFile(dir=path.parent):
                self._path = path.absolute()
        except OSError as error:
            raise _unwritable(path, error) from None

    def flies_again(self, flight: Flight) -> bool:
        """No."""
        with atomic_file(self._path, replace=False) as part:
            write_tlog(flight, part)
        return False

    def announce(self, text: str) -> None:
        """To nobody."""

    def summary(self) -> list[str]:
        """Nothing to be said."""
        return []


def pacing_line(error: PacingError) -> str:
    """How well time was kept."""
    return (
        f"real time: samples began {1e3 * error.median:.2f} ms late in the median, "
        f"{1e3 * error.p99:.2f} ms at 99 %, {1e3 * error.largest:.1f} ms at most; "
        f"{error.overruns} of {error.samples} later than one sample"
    )


@contextmanager
def live_flight(
    scenario: Scenario, factor: float | None, link: Link, log: Path | None, linger: float
) -> Iterator[LiveFlight]:
    """A vehicle that is there from now to the end of the block.

    Args:
        scenario: to be flown.
        factor: seconds of flight a second, or None to fly flat out.
        link: endpoint and identity.
        log: telemetry log to be written.
        linger: for how long the vehicle stays after its flight [s].

    Raises:
        LinkError: the endpoint or the log cannot be used.
        WriteError: afterwards, the log is not complete.
    """
    queue = CommandQueue()
    pacer = Pacer(scenario.loop.rate, factor, queue) if factor else None
    tlog = _opened_log(log) if log else None
    before = sys.getswitchinterval()
    try:
        vehicle = Vehicle(scenario, queue, link, tlog, pacer)
        live = LiveFlight(vehicle, pacer, queue, linger)
        if link.endpoint is not None and link.endpoint.port == 0:
            live.note = f"the vehicle listens at {vehicle.endpoint}"
        sys.setswitchinterval(SWITCH_INTERVAL)
        try:
            yield live
        finally:
            live.statistics = vehicle.close()
    finally:
        sys.setswitchinterval(before)
        if tlog is not None:
            tlog.close()
    if tlog is not None:
        tlog.check()


def _opened_log(path: Path) -> TelemetryLog:
    try:
        return TelemetryLog(path)
    except OSError as error:
        raise _unwritable(path, error) from None


def _unwritable(path: Path, error: OSError) -> LinkError:
    return LinkError(f"--tlog {path}: cannot be written: {error.strerror}")
