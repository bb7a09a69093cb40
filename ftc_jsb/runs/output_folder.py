"""Folders for results: one process each, writable before anything is flown, gone again if nothing was."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import datetime
from pathlib import Path

from filelock import FileLock, Timeout

from ftc_jsb.atomic_file import PART, remove_parts
from ftc_jsb.errors import RecordingError

LOCK = ".ftc-jsb.lock"  # held by the process that writes; the system lets go of it if that dies


@contextmanager
def output_folder(out: Path | None, name: str, force: bool, key: str = "--out") -> Iterator[Path]:
    """A folder that this process alone writes to. If the work in it fails and leaves nothing, it is removed.

    Args:
        out: as given, or None for ./out/<name>-<date-time>.
        name: of the default folder.
        force: accept a folder that is not empty.
        key: what the command line calls it.

    Raises:
        RecordingError: the folder is not empty, is in use, or cannot be made or written.
    """
    folder = out or _unused(Path("out") / f"{name}-{datetime.now():%Y%m%d-%H%M%S}")
    absolute = folder.absolute()  # whatever becomes of the working folder
    made = out is None or not folder.exists()
    lock = _locked(folder, key)
    try:
        try:
            _prepare(folder, force, key)
            yield folder
        finally:
            with suppress(OSError):
                (absolute / LOCK).unlink(missing_ok=True)
    finally:
        lock.release()
        if made:
            _remove_empty(absolute, out is None)


def _remove_empty(folder: Path, with_parent: bool) -> None:
    with suppress(OSError):  # not empty
        folder.rmdir()
        if with_parent:
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


def _locked(folder: Path, key: str) -> FileLock:
    """The lock of a folder, which is made if need be.

    Raises:
        RecordingError: another process has it, or it cannot be made.
    """
    try:
        if folder.exists() and not folder.is_dir():
            raise RecordingError(f"{key} {folder}: is a file; expected a folder")
        folder.mkdir(parents=True, exist_ok=True)
        lock = FileLock(folder / LOCK, blocking=False)
        lock.acquire()
        return lock
    except Timeout:
        raise RecordingError(
            f"{key} {folder}: another process is writing there; give another folder"
        ) from None
    except OSError as error:
        raise RecordingError(f"{key} {folder}: cannot be written: {error.strerror}") from None


def _prepare(folder: Path, force: bool, key: str) -> None:
    """See that a locked folder is free; what a killed process left half-written is removed."""
    finished = [p for p in folder.iterdir() if p.name != LOCK and p.suffix != PART]
    if finished and not force:
        raise RecordingError(f"{key} {folder}: is not empty; give another folder, or --force")
    remove_parts(folder)
