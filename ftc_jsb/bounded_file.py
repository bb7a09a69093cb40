"""Files that a user names, read with bounds: regular ones, of a size that such a file may have."""

import os
import stat
from pathlib import Path


class UnreadableError(ValueError):
    """A file cannot be read; the message says why and does not name it."""


def read_bounded(path: Path, most: int) -> bytes:
    """The contents of a regular file.

    Args:
        path: of the file; a device or a pipe, which may have no end, is refused.
        most: bytes that such a file may have.

    Raises:
        UnreadableError: no such file, no regular one, or larger.
    """
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
        with os.fdopen(descriptor, "rb") as file:
            found = os.fstat(file.fileno())
            if not stat.S_ISREG(found.st_mode):
                raise UnreadableError("cannot be read: is no regular file")
            contents = file.read(most + 1)
    except (OSError, ValueError) as error:  # a path with a zero byte in it is a ValueError
        if isinstance(error, UnreadableError):
            raise
        reason = getattr(error, "strerror", None) or str(error)
        raise UnreadableError(f"cannot be read: {reason}") from None
    if len(contents) > most:
        raise UnreadableError(f"cannot be read: larger than {most} bytes, which no such file is")
    return contents


def read_bounded_text(path: Path, most: int) -> str:
    """As `read_bounded`, of a text in UTF-8.

    Raises:
        UnreadableError: as there, or not UTF-8.
    """
    try:
        return read_bounded(path, most).decode("utf-8")
    except UnicodeDecodeError as error:
        raise UnreadableError(f"cannot be read: not UTF-8: {error}") from None


def is_folder(path: Path) -> bool:
    """Whether there is a folder; a path that nothing can have names none."""
    try:
        return path.is_dir()
    except (OSError, ValueError):
        return False


def is_file(path: Path) -> bool:
    """Whether there is a regular file; a path that no file can have names none."""
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False
