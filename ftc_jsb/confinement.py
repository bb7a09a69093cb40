"""Paths made of names that a file gives: they stay in the folder that they are meant for."""

from pathlib import Path


class OutsideError(ValueError):
    """A name leads out of its folder; the message says which, and does not name the file it is from."""


def confined(folder: Path, name: str) -> Path:
    """The path of `name` in `folder`, links resolved.

    Args:
        folder: that must hold it; need not be there.
        name: as a file gives it.

    Raises:
        OutsideError: it leads elsewhere, or is no name of a file.
    """
    try:
        inside = folder.resolve()
        path = (inside / name).resolve()
    except (OSError, ValueError, RuntimeError):  # too long, a zero byte, links in a circle
        path = inside = Path()
    if path == inside or not path.is_relative_to(inside):
        raise OutsideError(f"{name[:80]!r}: expected a name of a file in {folder}")
    return path
