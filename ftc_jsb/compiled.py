"""One place that decides how numerical kernels are compiled and cached.

Numba's own cache only notices a change in the file that defines a kernel, not in the kernels it
calls, and it wants to write beside the source. Both are wrong for an installed program, so the
cache lives in the user's cache folder, in a sub-folder named after the source of all that kernels
are made from.
"""

import hashlib
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
import platformdirs

Kernel = TypeVar("Kernel", bound=Callable[..., Any])


_WITHOUT_KERNELS = {
    "cli.py",
    "convert",
    "mavlink",
    "metrics.py",
    "report",
    "resources.py",
    "scenario",
    "typed_file.py",
}


@cache
def kernel_cache() -> Path:
    """Folder of compiled kernels of this source; a temporary one if it cannot be written."""
    package = Path(__file__).parent
    digest = hashlib.sha256(numba.__version__.encode())
    for source in sorted(package.rglob("*.py")):
        if source.relative_to(package).parts[0] not in _WITHOUT_KERNELS:
            digest.update(source.read_bytes())
    name = digest.hexdigest()[:16]
    folder = Path(platformdirs.user_cache_dir("ftc-jsb")) / "kernels" / name
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError:
        return Path(tempfile.mkdtemp(prefix="ftc-jsb-kernels-"))


def is_first_run() -> bool:
    """Whether no kernel of this source has been compiled on this machine yet."""
    return not any(kernel_cache().iterdir())


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
    config.CACHE_DIR = str(kernel_cache())
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
