"""How a vehicle is reached, and what has gone over its link."""

from typing import NamedTuple

from ftc_jsb.mavlink.link.endpoint import Endpoint


class Link(NamedTuple):
    """How the vehicle is reached, and by whom."""

    endpoint: Endpoint | None = None
    system: int = 1
    key: bytes | None = None
    readonly: bool = False


class Tally(NamedTuple):
    """What has gone over the link."""

    sent: int
    unsent: int
    received: int
    refused: int  # broken, unknown or not trusted
    ignored: int  # understood, but not for us or the link is read-only
    clamped: int
    errors: tuple[str, ...]  # of this program; none is expected
