"""Ports that are held, not guessed."""

import socket
from collections.abc import Iterator
from contextlib import contextmanager

HOST = "127.0.0.1"


@contextmanager
def reserved_port() -> Iterator[int]:
    """A UDP port of this machine that nobody answers, and that no other program is given.

    The socket that holds it is connected to itself: what others send to the port is refused. A
    station that shares addresses (SO_REUSEADDR, as MAVProxy and MAVSDK do) can bind the port
    beside it, and then hears all.
    """
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as holder:
        holder.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        holder.bind((HOST, 0))
        holder.connect(holder.getsockname())
        yield holder.getsockname()[1]
