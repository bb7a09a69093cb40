"""One place that decides how numerical kernels are compiled and cached.

Numba's own cache only notices a change in the file that defines a kernel, not in the kernels it
calls, and it wants to write beside the source. Both are wrong for an installed program, so the
cache lives in the user's cache folder, for each module in a sub-folder named after the source of all
that its kernels can be made from.
"""

import hashlib
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
import platformdirs

from ftc_jsb.sources import source_digest

Kernel = TypeVar("Kernel", bound=Callable[..., Any])


@cache
def kernel_cache(module: str) -> Path:
    """Folder of the compiled kernels of a module; a temporary one if it cannot be written.

    Its name follows from the source of all that the module imports: constants that a kernel takes
    from elsewhere are compiled into it.
    """
    name = hashlib.sha256(f"{numba.__version__} {source_digest(module)}".encode()).hexdigest()[:16]
    try:
        folder = _root() / name
        folder.mkdir(exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError:
        return _temporary()


@cache
def _root() -> Path:
    folder = Path(platformdirs.user_cache_dir("ftc-jsb")) / "kernels"
    folder.mkdir(parents=True, exist_ok=True)
    return folder


@cache
def _temporary() -> Path:
    return Path(tempfile.mkdtemp(prefix="ftc-jsb-kernels-"))


def is_first_run(module: str) -> bool:
    """Whether the kernels of a module, as its source is now, have not been compiled here yet."""
    return not any(kernel_cache(module).iterdir())


def compiled(function: Kernel) -> Kernel:
    """Compile `function` with Numba, cached on disk.

    Division by zero gives inf or nan as in NumPy (a departed flight is reported by the monitor,
    not by an exception), and fast-math stays off: the same flight is bit-identical every time.
    """
    return _cached(function)


def inlined(function: Kernel) -> Kernel:
    """As `compiled`, and always a part of the kernels that call it.

    A `Condition` is twenty numbers: handing it over costs more than a rate of (41) does.
    """
    return _cached(function, forceinline=True)


def _cached(function: Kernel, **options: Any) -> Kernel:
    config: Any = numba.config
    previous = config.CACHE_DIR
    config.CACHE_DIR = str(kernel_cache(function.__module__))
    try:
        return cast(Kernel, numba.njit(cache=True, error_model="numpy", **options)(function))
    finally:
        config.CACHE_DIR = previous


def compiled_in_memory(function: Kernel) -> Kernel:
    """As `compiled`, without the disk: for kernels that are closures over other kernels."""
    return cast(Kernel, numba.njit(error_model="numpy")(function))


def direct(kernel: Callable[..., Any], *example: Any) -> Callable[..., Any]:
    """Entry point of `kernel` for arguments typed like `example`.

    Skips Numba's type dispatch: 0.1 µs a call in place of 0.4 µs with structured arrays. The
    caller must pass arguments of the same types ever after.
    """
    dispatcher = cast(Any, kernel)
    signature = tuple(map(cast(Any, numba.typeof), example))
    dispatcher.compile(signature)
    return cast(Callable[..., Any], dispatcher.overloads[signature].entry_point)
