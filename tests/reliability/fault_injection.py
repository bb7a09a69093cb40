"""Makes one write, rename, fsync or read of the cache fail in a command, and says what is left of its files.

A command runs in a copy of this process, so that kernels and libraries need not be loaded again. Each
call of the operating system that touches a file below the folders given is a point, numbered in the
order of the run; at one of them the call fails with ENOSPC or EIO, or the process is killed.
"""

import builtins
import errno
import io
import json
import os
import resource
import signal
import sys
import tomllib
import traceback
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import netCDF4
import pyarrow.parquet

from ftc_jsb import verified_cache
from ftc_jsb.cli import main
from ftc_jsb.errors import RecordingError
from ftc_jsb.recording.netcdf import load

KINDS = ("ENOSPC", "EIO", "kill")
BEYOND = 10**9  # a point that is never reached: nothing fails, and points are counted


class Run(NamedTuple):
    """How a command ended."""

    code: int  # exit code; minus the signal
    points: int  # that it reached
    said: str  # on both outputs


class _Injector:
    def __init__(self, kind: str, at: int, folders: Sequence[Path], counter: Path) -> None:
        self._kind, self._at = kind, at
        self._folders = [str(folder.resolve()) for folder in folders]
        self._counter = os.open(counter, os.O_WRONLY | os.O_CREAT, 0o600)
        self._reached = 0

    def reach(self, path: Any) -> None:
        """One more point, if the path is below the folders."""
        if not isinstance(path, str | os.PathLike):
            return
        where = os.path.abspath(os.fspath(path))
        if not any(where.startswith(str(folder)) for folder in self._folders):
            return
        self._reached += 1
        os.pwrite(self._counter, b"%d\n" % self._reached, 0)
        if self._reached != self._at:
            return
        if self._kind == "kill":
            os.kill(os.getpid(), signal.SIGKILL)
        code = getattr(errno, self._kind)
        raise OSError(code, os.strerror(code), where)

    def before(self, function: Callable[..., Any], argument: int = 0) -> Callable[..., Any]:
        """`function`, which is a point by one of its arguments."""

        def called(*given: Any, **options: Any) -> Any:
            self.reach(given[argument] if len(given) > argument else None)
            return function(*given, **options)

        return called

    def opened(self, function: Callable[..., Any]) -> Callable[..., Any]:
        """`open`, which is a point when it is for writing."""

        def called(file: Any, mode: str = "r", *given: Any, **options: Any) -> Any:
            if isinstance(mode, str) and set(mode) & set("wax+"):
                self.reach(file)
            return function(file, mode, *given, **options)

        return called


def run(
    arguments: Sequence[str], folders: Sequence[Path], kind: str, at: int, scratch: Path,
    prepare: Callable[[], None] = lambda: None,
) -> Run:  # fmt: skip
    """Run a command in a copy of this process.

    Args:
        arguments: of `ftc-jsb`.
        folders: whose files are points.
        kind: how the point fails, one of KINDS.
        at: number of the point that fails, from 1.
        scratch: folder for what it says.
        prepare: called in the copy before the command.
    """
    counter, output = scratch / "points", scratch / "said"
    for path in (counter, output):
        path.unlink(missing_ok=True)
    child = os.fork()
    if child == 0:
        os._exit(_command(arguments, _Injector(kind, at, folders, counter), output, prepare))
    _, status = os.waitpid(child, 0)
    code = os.waitstatus_to_exitcode(status)
    points = int(counter.read_text() or 0) if counter.is_file() else 0
    return Run(code, points, output.read_text(errors="replace"))


def _command(
    arguments: Sequence[str], injector: _Injector, output: Path, prepare: Callable[[], None]
) -> int:
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    handle = os.open(output, os.O_WRONLY | os.O_CREAT, 0o600)
    os.dup2(handle, 1)
    os.dup2(handle, 2)
    sys.stdout = os.fdopen(1, "w", buffering=1)
    sys.stderr = os.fdopen(2, "w", buffering=1)
    sys.argv = ["ftc-jsb", *arguments]
    prepare()
    os.replace = injector.before(os.replace, 1)
    os.rename = injector.before(os.rename, 1)
    os.link = injector.before(os.link, 1)
    os.mkdir = injector.before(os.mkdir)
    by_number = os.fsync
    builtins.open = io.open = injector.opened(open)  # type: ignore[assignment]
    os.fsync = lambda number: (  # type: ignore[assignment]
        injector.reach(os.readlink(f"/proc/self/fd/{number}")), by_number(number)
    )[1]  # fmt: skip
    netCDF4.Dataset = _dataset(injector)
    verified_cache.read_sealed = injector.before(verified_cache.read_sealed)  # type: ignore[assignment]
    try:
        main(list(arguments), standalone_mode=True)
    except SystemExit as ended:
        code = ended.code
        return code if isinstance(code, int) else 0 if code is None else 1
    except BaseException:
        traceback.print_exc()
        return 99
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
    return 0


def _dataset(injector: _Injector) -> Any:
    whole = netCDF4.Dataset

    class Dataset(whole):  # type: ignore[misc, valid-type]
        """As the library's; making a file is a point, and writing its variables is one."""

        def __init__(self, path: Any, mode: str = "r", *given: Any, **options: Any) -> None:
            if mode == "w":
                injector.reach(path)
            super().__init__(path, mode, *given, **options)
            self.__dict__["_made"] = path if mode == "w" else None

        def close(self) -> Any:
            """The library writes what it has kept."""
            injector.reach(self.__dict__.get("_made"))
            return super().close()

        def __exit__(self, *what: Any) -> None:
            self.close()

    return Dataset


def damaged(folder: Path) -> list[str]:
    """What is wrong with finished files below a folder: those that have their own names."""
    return [
        f"{path.relative_to(folder)}: {problem}"
        for path in sorted(folder.rglob("*"))
        if path.is_file() and not any(part.endswith(".part") for part in path.parts)
        if (problem := _problem(path))
    ]


def _problem(path: Path) -> str:
    try:
        if path.suffix == ".nc":
            load(path)
        elif path.suffix == ".json":
            json.loads(path.read_text())
        elif path.suffix == ".toml":
            tomllib.loads(path.read_text())
        elif path.suffix == ".parquet":
            pyarrow.parquet.ParquetFile(path).read()
        elif path.suffix == ".html":
            return "" if path.read_text().rstrip().endswith("</html>") else "cut short"
        elif path.suffix in (".png", ".svg"):
            return "" if path.stat().st_size > 100 else "cut short"  # bytes
    except (RecordingError, ValueError, OSError) as error:
        return str(error)
    return ""
