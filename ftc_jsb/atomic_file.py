"""One place that writes files: under a temporary name, on the disk, and only then under its own.

Whoever looks finds the file whole or not at all, whatever fails and whenever the process is killed;
two processes that write the same file do not see each other's temporary ones.
"""

import errno
import os
import secrets
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ftc_jsb.errors import WriteError

PART = ".part"  # what temporary names end with


@contextmanager
def atomic_file(path: Path, *, replace: bool = True, durable: bool = True) -> Iterator[Path]:
    """A temporary path beside `path` to write to; when the block ends, the file becomes `path`.

    If the block raises, `path` stays as it was and the temporary file is gone.

    Args:
        path: what the file shall be.
        replace: whether a file that is there already is replaced.
        durable: whether the file is on the disk when the block ends, and survives a power failure.

    Raises:
        WriteError: the file cannot be written, or is there and shall not be replaced.
    """
    path = path.resolve()  # a link stays one
    if path.exists() and not path.is_file():
        raise WriteError(path, "is no regular file")
    part = path.with_name(f"{path.name}.{secrets.token_hex(6)}{PART}")
    try:
        try:
            yield part
            if durable:
                _to_disk(part)
            if replace:
                os.replace(part, path)
            else:
                _become_new(part, path)
            if durable:
                _to_disk(path.parent)
        except FileExistsError:
            raise WriteError(path, "exists") from None
        except OSError as error:
            raise WriteError(path, error.strerror or str(error)) from error
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    """Write a text file, UTF-8, as `atomic_file` does.

    Raises:
        WriteError: it cannot be written.
    """
    with atomic_file(path) as part:
        part.write_text(text, encoding="utf-8")


@contextmanager
def atomic_folder(path: Path) -> Iterator[Path]:
    """A temporary folder beside `path` to fill; when the block ends, it becomes `path`.

    A folder of that name that another process made meanwhile is kept, and this one dropped.

    Args:
        path: what the folder shall be; its parent is made if need be.

    Raises:
        WriteError: the folder cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(
            dir=path.parent, prefix=f"{path.name}.", suffix=PART
        ) as scratch:
            filled = Path(scratch) / "filled"
            filled.mkdir()
            yield filled
            for file in sorted(filled.rglob("*")):
                _to_disk(file)
            try:
                filled.rename(path)
            except OSError:
                if not path.is_dir():
                    raise
            _to_disk(path.parent)
    except OSError as error:
        raise WriteError(path, error.strerror or str(error)) from error


@contextmanager
def atomic_contents(folder: Path) -> Iterator[Path]:
    """A temporary folder to fill; when the block ends, each file in it moves to its place in `folder`.

    If the block raises, `folder` stays as it was. Files of the same names are replaced, one by one.

    Args:
        folder: exists.

    Raises:
        WriteError: the folder cannot be written.
    """
    try:
        with tempfile.TemporaryDirectory(dir=folder, suffix=PART) as scratch:
            filled = Path(scratch)
            yield filled
            for file in sorted(path for path in filled.rglob("*") if path.is_file()):
                place = folder / file.relative_to(filled)
                place.parent.mkdir(parents=True, exist_ok=True)
                _to_disk(file)
                os.replace(file, place)
                _to_disk(place.parent)
    except OSError as error:
        raise WriteError(folder, error.strerror or str(error)) from error


def remove_parts(folder: Path) -> None:
    """Remove what a killed process has left under temporary names; nobody else may be writing there."""
    for part in list(folder.rglob(f"*{PART}")):
        if part.is_dir():
            shutil.rmtree(part, ignore_errors=True)
        else:
            with suppress(OSError):
                part.unlink()


def _become_new(part: Path, path: Path) -> None:
    """Give a file its name unless the name is taken; raises FileExistsError if it is."""
    try:
        os.link(part, path)
    except FileExistsError:
        raise
    except OSError:  # a file system without hard links
        if path.exists():
            raise FileExistsError from None
        os.replace(part, path)


def _to_disk(path: Path) -> None:
    """Have what was written to a file or a folder on the disk; raises OSError if the disk fails."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    except OSError as error:
        if error.errno not in (errno.EINVAL, errno.ENOTSUP):  # a file system that has no such thing
            raise
    finally:
        os.close(descriptor)
