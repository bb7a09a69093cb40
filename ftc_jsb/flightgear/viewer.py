"""FlightGear as a viewer of a flight or of a recording, over UDP."""

import math
import socket
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from typing import Any, NamedTuple

import numpy.typing as npt

from ftc_jsb.errors import ScenarioError
from ftc_jsb.flightgear.packets import packet
from ftc_jsb.recording.flight import Flight
from ftc_jsb.scenario.schema import Initial, Scenario
from ftc_jsb.simulation.advance import Observer

RATE = 60.0  # [Hz] of flight, about: a whole number of samples apart

Factory = Callable[[str], AbstractContextManager[Sequence[Observer]]]


class Viewer(NamedTuple):
    """Where FlightGear listens: `fgfs --fdm=null --native-fdm=socket,in,60,HOST,PORT,udp`."""

    host: str
    port: int


def viewer(endpoint: str) -> Viewer:
    """HOST:PORT of the command line.

    Raises:
        ScenarioError: it is none.
    """
    host, colon, port = endpoint.rpartition(":")
    if not (colon and host and port.isascii() and port.isdigit() and 0 < int(port) < 65536):
        raise ScenarioError(
            f"--flightgear {endpoint!r}: expected HOST:PORT, such as 127.0.0.1:5550"
        )
    return Viewer(host, int(port))


def start_line(where: Viewer, initial: Initial) -> str:
    """Command that starts FlightGear to look on, at noon of the scenario's place.

    FlightGear makes its clock from the place that it is started at, and keeps it wherever it is sent.
    """
    return (
        f"fgfs --fdm=null --native-fdm=socket,in,{RATE:g},,{where.port},udp --aircraft=ufo "
        f"--lat={initial.latitude_deg:g} --lon={initial.longitude_deg:g} --timeofday=noon"
    )


class Sender:
    """An observer that sends what is flown to FlightGear; it watches only."""

    def __init__(self, where: Viewer, initial: Initial) -> None:
        """Args: FlightGear; [initial] of the scenario.

        Raises:
            ScenarioError: there is no such host.
        """
        try:
            self._there = socket.getaddrinfo(*where, socket.AF_INET, socket.SOCK_DGRAM)[0][4]
        except OSError as error:
            raise ScenarioError(f"--flightgear {where.host}: {error.strerror}") from None
        self._initial = initial
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._due = -math.inf

    def __call__(self, record: npt.NDArray[Any], i: int) -> None:
        """Row `i` has been flown."""
        now = float(record[i]["time"])
        if i == 0:
            self._due = now
        if now < self._due - 1e-9:
            return
        self._due = max(self._due + 1.0 / RATE, now)
        try:
            self._socket.sendto(packet(record[i], self._initial), self._there)
        except OSError:  # nobody looks
            return

    def close(self) -> None:
        """Let the socket go."""
        self._socket.close()


def shown_to(endpoint: str, scenario: Scenario, observers_for: Factory) -> Factory:
    """The same observers, and one that shows the flight in FlightGear.

    Args:
        endpoint: HOST:PORT of the command line.
        scenario: that is flown.
        observers_for: gives the others.

    Raises:
        ScenarioError: the endpoint is none.
    """
    where = viewer(endpoint)

    @contextmanager
    def shown(label: str) -> Iterator[Sequence[Observer]]:
        sender = Sender(where, scenario.initial)
        try:
            with observers_for(label) as observers:
                yield [*observers, sender]
        finally:
            sender.close()

    return shown


def show(endpoint: str, flight: Flight, factor: float = 1.0) -> None:
    """Show a recording, `factor` seconds of it a second, as it was flown.

    Raises:
        ScenarioError: the endpoint is none.
    """
    sender = Sender(viewer(endpoint), flight.scenario.initial)
    started = time.perf_counter()
    try:
        for i in range(flight.record.size):
            due = started + float(flight.record[i]["time"]) / factor
            time.sleep(max(due - time.perf_counter(), 0.0))
            sender(flight.record, i)
    finally:
        sender.close()
