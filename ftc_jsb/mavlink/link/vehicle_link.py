"""How a vehicle is reached, and what has gone over its link."""

from typing import NamedTuple

from ftc_jsb.mavlink.link.endpoint import Endpoint


class Link(NamedTuple):
    """How the vehicle is reached, and by whom."""

    endpoint: Endpoint | None = None
    system: int = 1  # MAVLink system id, 1 to 255
    key: bytes | None = None  # secret of 32 bytes; with it the link is signed
    readonly: bool = False  # whether all that stations say is ignored


class LinkStatistics(NamedTuple):
    """What has gone over the link, in frames."""

    sent: int
    unsent: int  # that a peer did not take
    received: int
    refused: int  # broken, unknown or not trusted
    ignored: int  # understood, but not for us or the link is read-only
    clamped: int  # values that did not fit their field
    errors: tuple[str, ...]  # of this program; none is expected
