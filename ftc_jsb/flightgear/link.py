"""The sockets of the exchange: lines in, lines out, over UDP."""

import socket
import time

from ftc_jsb.errors import LinkError
from ftc_jsb.flightgear.lines import LONGEST

Address = tuple[str, int]
DATAGRAM = 65536  # [bytes], the longest


class SimulatorLink:
    """Receives lines at one address, sends to another."""

    def __init__(self, here: Address, there: Address) -> None:
        """Args: where lines come to; where they go.

        Raises:
            LinkError: an address cannot be used.
        """
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self._socket.bind(here)
            self.there = socket.getaddrinfo(*there, socket.AF_INET, socket.SOCK_DGRAM)[0][4]
        except OSError as error:
            self._socket.close()
            raise LinkError(f"{here[0]}:{here[1]}: cannot be used: {error.strerror}") from None

    @property
    def port(self) -> int:
        """Where lines come to."""
        return int(self._socket.getsockname()[1])

    def receive(self, timeout: float) -> list[bytes]:
        """Lines that have come, waiting up to `timeout` seconds for the first."""
        self._socket.settimeout(max(timeout, 1e-3))
        lines: list[bytes] = []
        try:
            while True:
                data = self._socket.recv(DATAGRAM)
                lines += [line[: LONGEST + 1] for line in data.splitlines() if line.strip()]
                self._socket.settimeout(1e-6)
                if len(lines) > 1000:  # a flood: what has come is looked at first
                    return lines
        except TimeoutError:
            return lines
        except OSError:  # nobody listens there yet
            time.sleep(min(timeout, 0.01))
            return lines

    def send(self, line: bytes) -> None:
        """Send a line; one that cannot be sent is lost, as any may be."""
        try:
            self._socket.sendto(line, self.there)
        except OSError:
            return

    def close(self) -> None:
        """Let the socket go."""
        self._socket.close()
