"""One place that decides how numerical kernels are compiled and cached.

Numba's own cache only notices a change in the file that defines a kernel, not in the kernels it
calls, wants to write beside the source, and loads whatever it finds. All of that is wrong for an
installed program: see `kernel_cache`.

With Numba's compiler switched off (`NUMBA_DISABLE_JIT=1`, as `make coverage` has it) kernels run as
plain Python, slower by some hundred times, so that a tracer sees their lines.
"""

import threading
from collections.abc import Callable
from functools import cache, wraps
from typing import Any, TypeVar, cast

import numba
import numpy as np

from ftc_jsb.called_kernel import CalledKernel
from ftc_jsb.kernel_cache import CalledKernelFiles, KernelFiles, kernel_folders

Kernel = TypeVar("Kernel", bound=Callable[..., Any])
TRIED = ("0.68.",)  # versions of Numba whose inner workings `called_kernel` is known to fit


def links_kernels() -> bool:
    """Whether kernels that kernels call are linked, which a first flight gains by; else Numba's own way."""
    return not is_switched_off() and numba.__version__.startswith(TRIED)


def is_first_run(module: str) -> bool:
    """Whether the kernels of a module, as its source is now, have yet to be compiled here."""
    return not is_switched_off() and not any(
        folder.is_dir() and any(folder.iterdir()) for folder in kernel_folders(module)
    )


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


def compiled_in_memory(function: Kernel) -> Kernel:
    """As `compiled`, without the disk: for kernels that are closures over other kernels."""
    return _jitted(function)


def _cached(function: Kernel, **options: Any) -> Kernel:
    made = _jitted(function, **options)
    if not is_switched_off():
        dispatcher = cast(Any, made)
        dispatcher._cache = KernelFiles(function)
    if links_kernels():
        dispatcher = cast(Any, made)
        called: Any = CalledKernel(function, dispatcher.targetoptions)
        called._cache = CalledKernelFiles(function)
        dispatcher.called = called
        # What Numba asks of a kernel when it compiles one that calls it
        dispatcher.get_call_template = called.get_call_template
        dispatcher.get_overload = called.get_overload
    return made


def _jitted(function: Kernel, **options: Any) -> Kernel:
    if is_switched_off():
        return _interpreted(function)
    return cast(Kernel, numba.njit(error_model="numpy", **options)(function))


def direct(kernel: Callable[..., Any], *example: Any) -> Callable[..., Any]:
    """Entry point of `kernel` for arguments typed like `example`.

    Skips Numba's type dispatch: 0.1 µs a call in place of 0.4 µs with structured arrays. The
    caller must pass arguments of the same types ever after.
    """
    if is_switched_off():
        return kernel
    dispatcher = cast(Any, kernel)
    signature = tuple(map(_type_of, example))
    dispatcher.compile(signature)
    return cast(Callable[..., Any], dispatcher.overloads[signature].entry_point)


def compile_called(kernel: Callable[..., Any], *example: Any) -> Any:
    """Compile `kernel` as kernels call it, and leave it on the disk for them.

    Args:
        kernel: of `compiled` or `inlined`.
        example: arguments, or what this function has returned for kernels that give them.

    Returns:
        Numba's type of what the kernel returns.
    """
    if is_switched_off():
        return None
    called = cast(Any, kernel).called if links_kernels() else cast(Any, kernel)
    signature = tuple(map(_type_of, example))
    called.compile(signature)
    return called.overloads[signature].signature.return_type


def _type_of(value: Any) -> Any:
    """Numba's type of a kernel's argument; of structured arrays, which it makes anew each time, once."""
    if isinstance(value, numba.types.Type):
        return value
    if isinstance(value, tuple):
        types = [_type_of(part) for part in value]
        return cast(Any, numba.types.BaseTuple).from_types(types, type(value))
    if isinstance(value, np.ndarray) and value.dtype.names is not None:
        contiguous = value.flags.c_contiguous and value.flags.writeable and value.flags.aligned
        if contiguous:
            return _type_of_records(value.dtype, value.ndim)
    return cast(Any, numba.typeof)(value)


@cache
def _type_of_records(dtype: np.dtype[Any], dimensions: int) -> Any:
    return cast(Any, numba.typeof)(np.zeros((1,) * dimensions, dtype))


def is_switched_off() -> bool:
    """Whether Numba has been told to compile nothing."""
    return bool(cast(Any, numba.config).DISABLE_JIT)


class _Interpreter(threading.local):
    """Whether a kernel is running in this thread."""

    running = False


_INTERPRETER = _Interpreter()


def _interpreted(function: Kernel) -> Kernel:
    """`function` as plain Python that takes what the compiled kernel takes.

    The outermost kernel hands on its structured arrays with fields as attributes, which Numba has
    and NumPy has not, and divides by zero without a warning, as the compiled kernel does.
    """

    @wraps(function)
    def run(*arguments: Any, **named: Any) -> Any:
        if _INTERPRETER.running:
            return function(*arguments, **named)
        _INTERPRETER.running = True
        try:
            with np.errstate(all="ignore"):
                given = {name: _with_attributes(value) for name, value in named.items()}
                return function(*map(_with_attributes, arguments), **given)
        finally:
            _INTERPRETER.running = False

    return cast(Kernel, run)


class _Record(np.void):  # type: ignore[misc]  # final in the stubs alone
    """An element of a structured array whose fields are attributes; NumPy's own is slower."""

    __getattr__ = np.void.__getitem__
    __setattr__ = np.void.__setitem__


def _with_attributes(value: Any) -> Any:
    """A view of a structured array or of a tuple of them, whose elements are `_Record`."""
    if isinstance(value, np.ndarray | np.void) and value.dtype.names is not None:
        return value.view(_record_type(value.dtype))
    if isinstance(value, tuple):
        parts = map(_with_attributes, value)
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    return value


@cache
def _record_type(plain: np.dtype[Any]) -> np.dtype[Any]:
    """The same layout, with `_Record` for every structure in it."""
    if plain.subdtype is not None:
        element, shape = plain.subdtype
        return np.dtype((_record_type(element), shape))
    if plain.fields is None:
        return plain
    places = list(plain.fields.values())
    layout = {
        "names": list(plain.fields),
        "formats": [_record_type(place[0]) for place in places],
        "offsets": [place[1] for place in places],
        "itemsize": plain.itemsize,
    }
    return np.dtype((_Record, layout))
