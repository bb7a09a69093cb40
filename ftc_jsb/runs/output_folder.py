"""Folders for results: seen to be writable before anything is flown, gone again if nothing was."""

from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path

from ftc_jsb.errors import RecordingError


@contextmanager
def output_folder(out: Path | None, name: str, force: bool, key: str = "--out") -> Iterator[Path]:
    """A folder that can be written. If the work in it fails and leaves nothing, it is removed.

    Args:
        out: as given, or None for ./out/<name>-<date-time>.
        name: of the default folder.
        force: accept a folder that is not empty.
        key: what the command line calls it.

    Raises:
        RecordingError: the folder is not empty, or cannot be made or written.
    """
    folder = out or _unused(Path("out") / f"{name}-{datetime.now():%Y%m%d-%H%M%S}")
    made = out is None or not folder.exists()
    _prepare(folder, force, key)
    try:
        yield folder
    finally:
        if made and not any(folder.iterdir()):
            folder.rmdir()
            if out is None and not any(folder.parent.iterdir()):
                folder.parent.rmdir()


def _unused(folder: Path) -> Path:
    """`folder`, or the first of folder-2, folder-3, ... that no other flight has taken; made.

    Raises:
        RecordingError: it cannot be made.
    """
    candidate, number = folder, 1
    while True:
        try:
            candidate.mkdir(parents=True)
            return candidate
        except FileExistsError:
            number += 1
            candidate = folder.with_name(f"{folder.name}-{number}")
        except OSError as error:
            raise RecordingError(f"--out {folder}: cannot be made: {error.strerror}") from None


def _prepare(folder: Path, force: bool, key: str) -> None:
    try:
        if folder.exists() and not folder.is_dir():
            raise RecordingError(f"{key} {folder}: is a file; expected a folder")
        if folder.is_dir() and any(folder.iterdir()) and not force:
            raise RecordingError(f"{key} {folder}: is not empty; give another folder, or --force")
        folder.mkdir(parents=True, exist_ok=True)
        probe = folder / ".ftc-jsb-write-test"
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise RecordingError(f"{key} {folder}: cannot be written: {error.strerror}") from None
