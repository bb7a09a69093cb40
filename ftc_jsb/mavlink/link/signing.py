"""The secret key of a signed link."""

import hashlib
from pathlib import Path

from ftc_jsb.bounded_file import UnreadableError, read_bounded
from ftc_jsb.errors import LinkError

SHORTEST_PHRASE = 8  # characters
LONGEST_FILE = 10_000  # bytes


def load_key(path: Path) -> bytes:
    """SHA-256 of the pass phrase in a file, as ground stations make their key of one.

    Raises:
        LinkError: no such file, or no pass phrase in it.
    """
    try:
        phrase = read_bounded(path, LONGEST_FILE).strip()
    except UnreadableError as error:
        raise LinkError(f"--mavlink-key {path}: {error}") from None
    if len(phrase) < SHORTEST_PHRASE or b"\n" in phrase:
        raise LinkError(
            f"--mavlink-key {path}: expected a pass phrase of one line, {SHORTEST_PHRASE} characters or more"
        )
    return hashlib.sha256(phrase).digest()
