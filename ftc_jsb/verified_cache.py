"""What is made once and kept: in the user's cache folder, and looked through before it is used.

A file that is not what was written is made again; so is a folder with a file changed, added or lost.
Where the user's cache cannot be written, a folder of the user's among the temporary files stands in for
it, the same one every time.
"""

import hashlib
import os
import shutil
import stat
import tempfile
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

import platformdirs
from filelock import FileLock

from ftc_jsb.atomic_file import atomic_file, atomic_folder
from ftc_jsb.errors import WriteError

NAME = "ftc-jsb"
SEAL = ".sha256"  # beside a folder: the digest of all that is in it
DIGEST = hashlib.sha256
DIGEST_SIZE = DIGEST().digest_size  # bytes that a sealed file begins with


def cache_folders() -> Iterator[Path]:
    """Where to look, and where to write, in this order; none of them need be there."""
    yield Path(platformdirs.user_cache_dir(NAME))
    try:
        stand_in = Path(tempfile.gettempdir()) / f"{NAME}-cache-{_user()}"
    except FileNotFoundError:  # no temporary folder can be written
        return
    if _is_ours(stand_in):
        yield stand_in


def read_sealed(path: Path) -> bytes | None:
    """What `write_sealed` wrote; None if there is no such file, or it is damaged and then gone."""
    try:
        contents = path.read_bytes()
    except OSError:
        return None
    payload = contents[DIGEST_SIZE:]
    if DIGEST(payload).digest() == contents[:DIGEST_SIZE]:
        return payload
    discard(path)
    return None


def write_sealed(path: Path, payload: bytes) -> None:
    """Write a file with its digest. Its folder is made if need be; a crash may lose it, and only that.

    Raises:
        WriteError: it cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise WriteError(path, error.strerror or str(error)) from None
    with atomic_file(path, durable=False) as part:
        part.write_bytes(DIGEST(payload).digest() + payload)


def read_cached(name: str) -> bytes | None:
    """What `write_cached` wrote; None if there is no such file that is whole."""
    for folder in cache_folders():
        payload = read_sealed(folder / name)
        if payload is not None:
            return payload
    return None


def write_cached(name: str, payload: bytes) -> None:
    """Write a sealed file of the cache, if it can be written anywhere; otherwise it is made again next time.

    Args:
        name: below the cache; follows from all that the payload was made from.
        payload: of the file.
    """
    for folder in cache_folders():
        with suppress(WriteError):  # a full or a read-only disk: the next folder
            write_sealed(folder / name, payload)
            return


def discard_cached(name: str) -> None:
    """Remove a file of the cache as far as that can be done."""
    for folder in cache_folders():
        discard(folder / name)


def sealed_folder(name: str, fill: Callable[[Path], None]) -> Path:
    """A folder of the cache that holds what `fill` makes, and nothing else; made if need be.

    Several processes may ask for it at once.

    Args:
        name: below the cache; follows from all that goes into the folder.
        fill: writes the contents into an empty folder.

    Raises:
        WriteError: it can be written nowhere.
    """
    found = find_sealed(name)
    if found is not None:
        return found
    problem = WriteError(name, "there is no cache folder")
    for folder in (cache / name for cache in cache_folders()):
        try:
            return _filled(folder, fill)
        except WriteError as error:
            problem = error
        except OSError as error:
            problem = WriteError(folder, error.strerror or str(error))
    raise problem


def find_sealed(name: str) -> Path | None:
    """A folder that `sealed_folder` made, as it was made; None if there is none."""
    folders = (cache / name for cache in cache_folders())
    return next((folder for folder in folders if _is_sealed(folder)), None)


def discard(path: Path) -> None:
    """Remove a file or a folder of the cache as far as that can be done."""
    with suppress(OSError):
        if path.is_dir():
            shutil.rmtree(path)
        else:
            path.unlink()


def _filled(folder: Path, fill: Callable[[Path], None]) -> Path:
    """One process fills; the others wait and then find it filled."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    seal = folder.with_name(folder.name + SEAL)
    with FileLock(folder.with_name(f"{folder.name}.lock")):
        if _is_sealed(folder):
            return folder
        seal.unlink(missing_ok=True)
        if folder.exists():  # damaged
            shutil.rmtree(folder)
        with atomic_folder(folder) as new:
            fill(new)
            digest = _digest(new)
        write_sealed(seal, digest)
    return folder


def _is_sealed(folder: Path) -> bool:
    try:
        return folder.is_dir() and read_sealed(folder.with_name(folder.name + SEAL)) == _digest(
            folder
        )
    except OSError:
        return False


def _digest(folder: Path) -> bytes:
    """Of the names and contents of all files below a folder."""
    digest = DIGEST()
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix().encode()
        contents = path.read_bytes() if path.is_file() else b""
        digest.update(b"%d %s %d " % (len(name), name, len(contents)))
        digest.update(contents)
    return digest.digest()


def _user() -> str:
    return str(os.getuid()) if hasattr(os, "getuid") else os.environ.get("USERNAME", "user")


def _is_ours(folder: Path) -> bool:
    """Whether a folder among the temporary files is this user's own, made if need be; nobody else may write."""
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        found = folder.lstat()
    except OSError:
        return False
    if not stat.S_ISDIR(found.st_mode):
        return False
    return not hasattr(os, "getuid") or (
        found.st_uid == os.getuid() and not found.st_mode & (stat.S_IWGRP | stat.S_IWOTH)
    )
