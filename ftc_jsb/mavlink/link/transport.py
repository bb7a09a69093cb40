"""Bytes to and from ground stations. Nothing here waits: what cannot be sent now is counted and gone."""

import selectors
import socket
import time
from collections.abc import Hashable, Iterator
from typing import Protocol

from ftc_jsb.mavlink.link.endpoint import Endpoint, open_socket

MOST_PEERS = 8
GRACE = 2.0  # [s] that a TCP client which nothing is heard of keeps its place from a newcomer
SILENT = 5.0  # [s] after which a peer gives way to a newcomer; stations are heard of every second
PEER_TIMEOUT = 30.0  # [s] of silence after which a peer of a UDP port is no longer sent to
BACKLOG = 256 * 1024  # [bytes] that a TCP client may be behind before frames are dropped
LARGEST_READ = (
    2048  # [bytes] of one read: no honest datagram is longer, and none takes long to parse
)


class Transport(Protocol):
    """A way to ground stations."""

    endpoint: Endpoint  # with the port that it has, where it was to be any
    unsent: int  # frames that a peer did not take

    def receive(self, limit: float) -> Iterator[tuple[Hashable, bytes, bool]]:
        """What has come: from whom, the bytes, and whether they go on from the ones before.

        Args:
            limit: the clock's time [s] after which no more is read.
        """

    def accept_peer(self, peer: Hashable) -> None:
        """A peer has sent a frame that is understood and trusted: it is sent to from now on."""

    def send(self, frame: bytes) -> None:
        """Send to every peer, or count."""

    def disconnected(self) -> list[Hashable]:
        """Peers that have left since the last call."""

    def close(self) -> None:
        """Close every socket."""


def open_transport(endpoint: Endpoint, selector: selectors.BaseSelector) -> Transport:
    """The transport of an endpoint; its sockets are registered with `selector`.

    Raises:
        LinkError: the endpoint cannot be used.
    """
    sock = open_socket(endpoint)
    if endpoint.port == 0:
        endpoint = endpoint._replace(port=sock.getsockname()[1])
    if endpoint.kind == "tcpin":
        return _TcpServer(endpoint, sock, selector)
    selector.register(sock, selectors.EVENT_READ)
    return _Udp(endpoint, sock)


class _Udp:
    def __init__(self, endpoint: Endpoint, sock: socket.socket) -> None:
        self.endpoint = endpoint
        self._socket = sock
        self._connected = endpoint.kind == "udpout"
        self._peers: dict[Hashable, float] = {}
        self.unsent = 0

    def receive(self, limit: float) -> Iterator[tuple[Hashable, bytes, bool]]:
        while time.monotonic() < limit:
            try:
                data, peer = self._socket.recvfrom(LARGEST_READ)
            except BlockingIOError:
                return
            except OSError:  # the other side's port is closed
                self.unsent += 1
                continue
            yield peer, data, False

    def accept_peer(self, peer: Hashable) -> None:
        now = time.monotonic()
        if peer not in self._peers and len(self._peers) >= MOST_PEERS:
            quietest = min(self._peers, key=self._peers.__getitem__)
            if self._peers[quietest] > now - SILENT:
                return
            del self._peers[quietest]
        self._peers[peer] = now

    def send(self, frame: bytes) -> None:
        if self._connected:
            try:
                self._socket.send(frame)
            except OSError:
                self.unsent += 1
            return
        oldest = time.monotonic() - PEER_TIMEOUT
        for peer in [peer for peer, heard in self._peers.items() if heard < oldest]:
            del self._peers[peer]
        for peer in self._peers:
            try:
                self._socket.sendto(frame, peer)  # type: ignore[call-overload]
            except OSError:
                self.unsent += 1

    def disconnected(self) -> list[Hashable]:
        return []

    def close(self) -> None:
        self._socket.close()


class _TcpServer:
    def __init__(
        self, endpoint: Endpoint, sock: socket.socket, selector: selectors.BaseSelector
    ) -> None:
        self.endpoint = endpoint
        self._server = sock
        self._selector = selector
        self._backlogs: dict[socket.socket, bytearray] = {}
        self._since: dict[socket.socket, float] = {}  # when it came, until it is understood
        self._heard: dict[socket.socket, float] = {}  # when it was last understood
        self._disconnected: list[Hashable] = []
        self.unsent = 0
        selector.register(sock, selectors.EVENT_READ)

    def receive(self, limit: float) -> Iterator[tuple[Hashable, bytes, bool]]:
        self._accept()
        for client in list(self._backlogs):
            while time.monotonic() < limit:
                try:
                    data = client.recv(LARGEST_READ)
                except BlockingIOError:
                    break
                except OSError:
                    data = b""
                if not data:
                    self._drop(client)
                    break
                yield client, data, True

    def _accept(self) -> None:
        try:
            client, _ = self._server.accept()
        except OSError:
            return
        if len(self._backlogs) >= MOST_PEERS and not self._make_room():
            client.close()
            return
        self._since[client] = time.monotonic()
        client.setblocking(False)
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._backlogs[client] = bytearray()
        self._selector.register(client, selectors.EVENT_READ)

    def _make_room(self) -> bool:
        """Drop who gives way to a newcomer: idle ones first, stations only after a long silence.

        So one that sends frames that are trusted keeps its place, however many others connect.
        """
        now = time.monotonic()
        idle = [client for client, came in self._since.items() if came < now - GRACE]
        silent = [client for client, heard in self._heard.items() if heard < now - PEER_TIMEOUT]
        for client in [*idle, *silent][:1]:
            self._drop(client)
            return True
        return False

    def accept_peer(self, peer: Hashable) -> None:
        """Who connects is sent to at once; whom we understand keeps its place."""
        if isinstance(peer, socket.socket) and peer in self._backlogs:
            self._since.pop(peer, None)
            self._heard[peer] = time.monotonic()

    def send(self, frame: bytes) -> None:
        for client, backlog in list(self._backlogs.items()):
            if len(backlog) + len(frame) > BACKLOG:
                self.unsent += 1
            else:
                backlog += frame
            try:
                del backlog[: client.send(backlog)]
            except BlockingIOError:
                continue
            except OSError:
                self.unsent += 1
                self._drop(client)

    def _drop(self, client: socket.socket) -> None:
        self._selector.unregister(client)
        client.close()
        del self._backlogs[client]
        self._since.pop(client, None)
        self._heard.pop(client, None)
        self._disconnected.append(client)

    def disconnected(self) -> list[Hashable]:
        left, self._disconnected = self._disconnected, []
        return left

    def close(self) -> None:
        for client in list(self._backlogs):
            self._drop(client)
        self._server.close()
