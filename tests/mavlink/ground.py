"""A ground station of the MAVLink library's own parser and packer, and flights for it to look at."""

import socket
import threading
import time
from contextlib import contextmanager, nullcontext
from pathlib import Path

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.link.encoder import signing_time
from ftc_jsb.mavlink.link.endpoint import Endpoint
from ftc_jsb.mavlink.link.vehicle_link import Link
from ftc_jsb.mavlink.live import live_flight
from ftc_jsb.recording.commands import End
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from tests.mavlink.ports import HOST, reserved_port

OPEN: list[socket.socket] = []  # of stations; closed with the flight that they looked at


class Ground:
    """Talks to the vehicle at a UDP or TCP port."""

    def __init__(
        self, port: int, key: bytes | None = None, stream: bool = False, system: int = 255
    ):
        kind = socket.SOCK_STREAM if stream else socket.SOCK_DGRAM
        self.socket = socket.socket(socket.AF_INET, kind)
        self.socket.connect((HOST, port))
        self.socket.settimeout(0.05)
        self.mav = dialect.MAVLink(None, system, dialect.MAV_COMP_ID_MISSIONPLANNER)
        self.mav.robust_parsing = True
        if key is not None:
            self.mav.signing.secret_key = key
            self.mav.signing.sign_outgoing = True
            self.mav.signing.timestamp = signing_time()
        OPEN.append(self.socket)
        self.heard: list = []
        self.silent = False
        self.beat()

    def frame(self, message) -> bytes:
        packed = message.pack(self.mav)
        self.mav.seq = (self.mav.seq + 1) % 256
        return packed

    def send(self, message) -> None:
        self.socket.send(self.frame(message))

    def beat(self) -> None:
        """As stations do every second, and this one as it listens."""
        self._beaten = time.monotonic()
        self.send(dialect.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3))

    def command(self, command: int, *params: float, system: int = 1, component: int = 1) -> None:
        filled = (*params, *(0.0,) * (7 - len(params)))
        self.send(dialect.MAVLink_command_long_message(system, component, command, 0, *filled))

    def listen(self, seconds: float) -> list:
        """Messages of the next while."""
        until, found = time.monotonic() + seconds, []
        while time.monotonic() < until:
            found += self._read()
        return found

    def _read(self) -> list:
        try:
            if not self.silent and time.monotonic() > self._beaten + 1.0:
                self.beat()
            data = self.socket.recv(65536)
        except (TimeoutError, ConnectionRefusedError):
            return []
        messages = [m for m in self.mav.parse_buffer(data) or () if m.get_type() != "BAD_DATA"]
        self.heard += messages
        return messages

    def wait_for(self, kind: str, wanted=lambda message: True, within: float = 20.0):
        """The next message of a kind.

        Raises:
            AssertionError: none came.
        """
        until = time.monotonic() + within
        while time.monotonic() < until:
            for message in self._read():
                if message.get_type() == kind and wanted(message):
                    return message
        raise AssertionError(
            f"no {kind} in {within} s; heard {sorted({m.get_type() for m in self.heard})}"
        )

    def ask(self, command: int, *params: float):
        """The result of a command."""
        self.command(command, *params)
        return self.wait_for("COMMAND_ACK", lambda ack: ack.command == command).result

    def close(self) -> None:
        self.socket.close()


class Aloft:
    """A flight that is under way in a thread."""

    def __init__(self, port: int, live) -> None:
        self.port, self.live, self.flight = port, live, None
        self.thread: threading.Thread | None = None

    def land(self):
        """End the flight; what was flown."""
        self.live.commands.put(End())
        self.thread.join(120.0)
        assert self.flight is not None
        return self.flight


@contextmanager
def aloft(
    *overrides: str, scenario="nominal", kind="udpin", factor=1.0, log: Path | None = None, **link
):
    """A vehicle that flies; after the block it has landed and the link is closed.

    It listens at a port that the system chooses; or it sends (udpout) to one that nobody answers.
    """
    flown = load_scenario(scenario, ["duration=120", *overrides])
    with (
        reserved_port() if kind == "udpout" else nullcontext(0) as port,
        live_flight(flown, factor, Link(Endpoint(kind, HOST, port), **link), log, 0.0) as live,
    ):
        up = Aloft(live.vehicle.endpoint.port, live)

        under_way = threading.Event()

        def run():
            observers = (*live.observers, lambda record, i: under_way.set())
            up.flight = fly(flown, observers, commands=live.commands)
            live.flies_again(up.flight)

        up.thread = threading.Thread(target=run)
        up.thread.start()
        assert under_way.wait(180.0)  # kernels may have to be compiled first
        try:
            yield up
        finally:
            up.land()
            while OPEN:
                OPEN.pop().close()
    assert live.statistics.errors == ()
