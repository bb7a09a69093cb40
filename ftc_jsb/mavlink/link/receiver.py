"""Frames from bytes that may be anything: only what is whole, known and trusted comes through."""

import logging
from collections.abc import Hashable
from typing import Any

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.link.encoder import signing_time

logging.getLogger(dialect.__name__).addHandler(logging.NullHandler())

LONGEST_UNFINISHED = 1024  # [bytes] of an unfinished frame of a stream: none is longer than 280


class _Parser(dialect.MAVLink):  # type: ignore[misc]
    """The library's parser; a bad signature leaves no trace in it.

    The library notes a stream's time stamp before it has checked the signature, so that one forged
    frame from the future would shut the true sender out.
    """

    def check_signature(self, msgbuf: bytearray, srcSystem: int, srcComponent: int) -> bool:  # noqa: N803
        streams = self.signing.stream_timestamps
        before = dict(streams)
        good: bool = super().check_signature(msgbuf, srcSystem, srcComponent)
        if not good:
            streams.clear()
            streams.update(before)
        return good


class Receiver:
    """Takes bytes apart, one parser for each stream of bytes; datagrams stand alone."""

    def __init__(self, key: bytes | None = None) -> None:
        """Args: secret key of 32 bytes; with it, only frames that are signed by it come through."""
        self.received = 0  # frames that came through
        self.refused = 0  # frames and bytes that did not: broken, unknown, not signed, badly signed
        self._signing = dialect.MAVLinkSigning()
        self._signing.secret_key = key
        self._signing.timestamp = signing_time()
        self._streams: dict[Hashable, _Parser] = {}
        self._datagram = self._parser()

    def _parser(self) -> _Parser:
        parser = _Parser(None)
        parser.robust_parsing = True
        parser.signing = self._signing
        return parser

    def forget(self, peer: Hashable) -> None:
        """A stream of bytes has ended."""
        self._streams.pop(peer, None)

    def messages(self, peer: Hashable, data: bytes, continues: bool) -> list[Any]:
        """Messages in `data`.

        Args:
            peer: who sent it.
            data: bytes.
            continues: whether frames may go on from one call to the next; a datagram's do not.
        """
        parser = self._datagram
        if continues:
            if peer not in self._streams:
                self._streams[peer] = self._parser()
            parser = self._streams[peer]
        if self._signing.secret_key is not None:
            self._signing.timestamp = max(self._signing.timestamp, signing_time())
        found = []
        for message in parser.parse_buffer(data) or ():
            if message.get_type() == "BAD_DATA" or message.get_type().startswith("UNKNOWN"):
                self.refused += 1
            else:
                found.append(message)
        if not continues and parser.buf_len():
            self.refused += 1
        if not continues or parser.buf_len() > LONGEST_UNFINISHED:
            parser.buf, parser.buf_index = bytearray(), 0
        self.received += len(found)
        return found
