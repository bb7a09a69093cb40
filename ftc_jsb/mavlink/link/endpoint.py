"""Endpoints as a user writes them, udpout:host:port, udpin:host:port, tcpin:host:port; their sockets."""

import ipaddress
import socket
from typing import Literal, NamedTuple, cast

from ftc_jsb.errors import LinkError

LOOPBACK = "127.0.0.1"
KINDS = ("udpout", "udpin", "tcpin")


class Endpoint(NamedTuple):
    """Where the vehicle sends to (udpout) or listens (udpin, tcpin; port 0 is any that is free)."""

    kind: Literal["udpout", "udpin", "tcpin"]
    host: str
    port: int

    @property
    def is_local(self) -> bool:
        """Whether nothing beyond this machine can reach it."""
        try:
            return ipaddress.ip_address(self.host).is_loopback
        except ValueError:
            return self.host == "localhost"

    def __str__(self) -> str:
        """As it was written."""
        return f"{self.kind}:{self.host}:{self.port}"


def parse_endpoint(text: str) -> Endpoint:
    """An endpoint; without a host it is this machine's loopback.

    Raises:
        LinkError: it is none.
    """
    kind, _, place = text.partition(":")
    host, colon, port = place.rpartition(":")
    if kind not in KINDS or not colon or not _is_port(kind, port):
        raise LinkError(
            f"--mavlink {text}: expected udpout:HOST:PORT, udpin:HOST:PORT or tcpin:HOST:PORT, "
            "such as udpout:127.0.0.1:14550"
        )
    return Endpoint(cast(Literal["udpout", "udpin", "tcpin"], kind), host or LOOPBACK, int(port))


def _is_port(kind: str, port: str) -> bool:
    """Whether the vehicle can listen at, or send to, a port; 0 is none that can be sent to."""
    lowest = 1 if kind == "udpout" else 0
    return port.isdecimal() and lowest <= int(port) <= 65535


def open_socket(endpoint: Endpoint) -> socket.socket:
    """A socket that never blocks, bound or connected.

    Raises:
        LinkError: unknown host, or a port that is taken.
    """
    kind = socket.SOCK_STREAM if endpoint.kind == "tcpin" else socket.SOCK_DGRAM
    place = (endpoint.host, endpoint.port)
    sock = socket.socket(socket.AF_INET, kind)
    try:
        sock.setblocking(False)
        if endpoint.kind == "udpout":
            sock.connect(place)  # replies are taken from there only
            return sock
        if endpoint.kind == "tcpin":
            sock.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        sock.bind(place)
        if endpoint.kind == "tcpin":
            sock.listen(4)
    except OSError as error:
        sock.close()
        raise LinkError(f"--mavlink {endpoint}: {error.strerror or error}") from None
    return sock
