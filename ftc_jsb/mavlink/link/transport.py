"""Bytes to and from ground stations. Nothing here waits: what cannot be sent now is counted and gone."""

import selectors
import socket
import time
from collections.abc import Hashable, Iterator
from typing import Protocol

from ftc_jsb.mavlink.link.endpoint import Endpoint, opened

MOST_PEERS = 8
SILENCE = 30.0  # [s] after which a peer of a UDP port is no longer sent to
BACKLOG = 256 * 1024  # [bytes] that a TCP client may be behind before frames are dropped
LARGEST = 2048  # [bytes] of one read: no honest datagram is longer, and none takes long to parse


class Transport(Protocol):
    """A way to ground stations."""

    unsent: int  # frames that a peer did not take

    def receive(self, limit: float) -> Iterator[tuple[Hashable, bytes, bool]]:
        """What has come: from whom, the bytes, and whether they go on from the ones before.

        Args:
            limit: the clock's time [s] after which no more is read.
        """

    def welcome(self, peer: Hashable) -> None:
        """A peer has sent a frame that is understood and trusted."""

    def send(self, frame: bytes) -> None:
        """Send to every peer, or count."""

    def gone(self) -> list[Hashable]:
        """Peers that have left since the last call."""

    def close(self) -> None:
        """Let go."""


def transport(endpoint: Endpoint, selector: selectors.BaseSelector) -> Transport:
    """The transport of an endpoint; its sockets are registered with `selector`."""
    sock = opened(endpoint)
    if endpoint.kind == "tcpin":
        return _TcpServer(sock, selector)
    selector.register(sock, selectors.EVENT_READ)
    return _Udp(sock, None if endpoint.kind == "udpin" else sock.getpeername())


class _Udp:
    def __init__(self, sock: socket.socket, peer: Hashable | None) -> None:
        self._socket = sock
        self._connected = peer is not None
        self._peers: dict[Hashable, float] = {}
        self.unsent = 0

    def receive(self, limit: float) -> Iterator[tuple[Hashable, bytes, bool]]:
        while time.monotonic() < limit:
            try:
                data, peer = self._socket.recvfrom(LARGEST)
            except BlockingIOError:
                return
            except OSError:  # the other side's port is closed
                self.unsent += 1
                continue
            yield peer, data, False

    def welcome(self, peer: Hashable) -> None:
        now = time.monotonic()
        if peer in self._peers or len(self._peers) < MOST_PEERS:
            self._peers[peer] = now

    def send(self, frame: bytes) -> None:
        if self._connected:
            try:
                self._socket.send(frame)
            except OSError:
                self.unsent += 1
            return
        oldest = time.monotonic() - SILENCE
        for peer in [peer for peer, heard in self._peers.items() if heard < oldest]:
            del self._peers[peer]
        for peer in self._peers:
            try:
                self._socket.sendto(frame, peer)  # type: ignore[call-overload]
            except OSError:
                self.unsent += 1

    def gone(self) -> list[Hashable]:
        return []

    def close(self) -> None:
        self._socket.close()


class _TcpServer:
    def __init__(self, sock: socket.socket, selector: selectors.BaseSelector) -> None:
        self._server = sock
        self._selector = selector
        self._waiting: dict[socket.socket, bytearray] = {}
        self._gone: list[Hashable] = []
        self.unsent = 0
        selector.register(sock, selectors.EVENT_READ)

    def receive(self, limit: float) -> Iterator[tuple[Hashable, bytes, bool]]:
        self._accept()
        for client in list(self._waiting):
            while time.monotonic() < limit:
                try:
                    data = client.recv(LARGEST)
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
        if len(self._waiting) >= MOST_PEERS:
            client.close()
            return
        client.setblocking(False)
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._waiting[client] = bytearray()
        self._selector.register(client, selectors.EVENT_READ)

    def welcome(self, peer: Hashable) -> None:
        pass  # who connects to a port of ours is sent to at once

    def send(self, frame: bytes) -> None:
        for client, waiting in list(self._waiting.items()):
            if len(waiting) + len(frame) > BACKLOG:
                self.unsent += 1
            else:
                waiting += frame
            try:
                del waiting[: client.send(waiting)]
            except BlockingIOError:
                continue
            except OSError:
                self.unsent += 1
                self._drop(client)

    def _drop(self, client: socket.socket) -> None:
        self._selector.unregister(client)
        client.close()
        del self._waiting[client]
        self._gone.append(client)

    def gone(self) -> list[Hashable]:
        gone, self._gone = self._gone, []
        return gone

    def close(self) -> None:
        for client in list(self._waiting):
            self._drop(client)
        self._server.close()
