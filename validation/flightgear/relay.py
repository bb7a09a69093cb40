"""A bad line between simulator and loop: lines are dropped, doubled, held back, and garbled."""

import random
import select
import socket
import threading
from typing import NamedTuple

SHARE = 0.1  # of lines that are dropped


class Ways(NamedTuple):
    """Ports that a relay listens at, and sends to."""

    listen: int
    send: int


class BadLine:
    """Relays datagrams both ways in a thread, worse than any line on one machine is."""

    def __init__(self, ways: list[Ways], seed: int = 1) -> None:
        """Args: each way; of what is drawn."""
        self._random = random.Random(seed)
        self._ways = {}
        for way in ways:
            sock = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            sock.bind(("127.0.0.1", way.listen))
            self._ways[sock] = way.send
        self._held: dict[int, bytes] = {}
        self._stop = threading.Event()
        self.dropped = self.passed = 0
        self._thread = threading.Thread(target=self._run, daemon=True)

    def __enter__(self) -> "BadLine":
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._stop.set()
        self._thread.join()
        for sock in self._ways:
            sock.close()

    def _run(self) -> None:
        while not self._stop.is_set():
            for sock in select.select(list(self._ways), [], [], 0.1)[0]:
                self._pass(sock.recv(65536), self._ways[sock], sock)

    def _pass(self, data: bytes, port: int, sock: socket.socket) -> None:
        chance = self._random.random()
        there = ("127.0.0.1", port)
        if chance < SHARE:
            self.dropped += 1
            return
        self.passed += 1
        if chance < SHARE + 0.02:  # held back until the next has gone: disorder
            self._held[port] = data
            return
        if chance < SHARE + 0.04:
            data = data[: len(data) // 2] + b"7" + data[len(data) // 2 + 1 :]
        sock.sendto(data, there)
        if chance > 0.97:
            sock.sendto(data, there)
        if port in self._held:
            sock.sendto(self._held.pop(port), there)
