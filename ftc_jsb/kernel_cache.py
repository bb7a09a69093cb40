"""Compiled kernels on disk: a file for each signature of each kernel, verified before it is loaded.

Numba's own cache loads what it finds: a damaged file ends the process, or makes every start fail. Of it
this takes what turns a kernel into bytes and back; the files are ours.
"""

import hashlib
import inspect
import pickle
import sys
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any, cast

import numba
from numba.core.caching import Cache, CompileResultCacheImpl
from numba.core.serialize import dumps

from ftc_jsb.called_kernel import rebuilt
from ftc_jsb.sources import source_digest
from ftc_jsb.verified_cache import (
    cache_folders,
    discard,
    discard_cached,
    read_cached,
    write_cached,
)

SUFFIX = ".kernel"


@cache
def kernels_of(module: str) -> str:
    """Name, below a cache folder, of what is compiled from a module.

    It follows from the source of all that the module imports: constants that a kernel takes from
    elsewhere are compiled into it.
    """
    made_from = f"{numba.__version__} {sys.version_info[:2]} {source_digest(module)}"
    return f"kernels/{hashlib.sha256(made_from.encode()).hexdigest()[:16]}"


def kernel_folders(module: str) -> Iterator[Path]:
    """Where kernels of a module are looked for and written, in this order."""
    return (folder / kernels_of(module) for folder in cache_folders())


class KernelFiles(Cache):
    """The cache of one kernel, as Numba's dispatcher asks for it. A disk that fails is no failure here."""

    def __init__(self, function: Callable[..., Any]) -> None:
        """Args: the kernel's Python function."""
        self._py_func = function
        self._name = repr(function)
        self._impl = _Conversion(function)
        self._enabled = True

    @property
    def cache_path(self) -> str:
        """Where it is written first."""
        return str(next(kernel_folders(self._py_func.__module__)))

    def flush(self) -> None:
        """Forget every signature."""
        for folder in kernel_folders(self._py_func.__module__):
            for path in folder.glob(f"{self._impl.base}.*{SUFFIX}"):
                discard(path)

    def _load_overload(self, signature: Any, target_context: Any) -> Any:
        key = self._key(signature, target_context.codegen())
        payload = read_cached(self._file(key))
        if payload is None:
            return None
        try:
            found, reduced = pickle.loads(payload)
            return self._impl.rebuild(target_context, reduced) if found == key else None
        except Exception:  # of another Numba, say
            discard_cached(self._file(key))
            return None

    def _save_overload(self, signature: Any, compiled: Any) -> None:
        if not self._impl.check_cachable(compiled):
            return
        key = self._key(signature, compiled.codegen)
        payload: bytes = cast(Any, dumps)((key, self._impl.reduce(compiled)))
        write_cached(self._file(key), payload)

    def _key(self, signature: Any, codegen: Any) -> Any:
        return cast(Any, self)._index_key(signature, codegen)

    def _file(self, key: Any) -> str:
        """Name of the file of a signature, below a cache folder."""
        digest = hashlib.sha256(repr(key).encode()).hexdigest()[:16]
        return f"{kernels_of(self._py_func.__module__)}/{self._impl.base}.{digest}{SUFFIX}"


class CalledKernelFiles(KernelFiles):
    """The cache of a kernel as other kernels call it."""

    def __init__(self, function: Callable[..., Any]) -> None:
        """Args: the kernel's Python function."""
        super().__init__(function)
        self._impl = _CalledConversion(function)


class _Conversion(CompileResultCacheImpl):
    """Numba's conversion of compiled kernels, without its search for a folder."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self._lineno = function.__code__.co_firstlineno
        self._py_file = inspect.getfile(function)
        self._locator = self  # whose `_py_file` a warning names
        plain = function.__qualname__.replace("<", "").replace(">", "")
        self.base = f"{Path(self._py_file).stem}.{plain}-{self._lineno}"


class _CalledConversion(_Conversion):
    def __init__(self, function: Callable[..., Any]) -> None:
        super().__init__(function)
        self.base += ".called"

    def rebuild(self, target_context: Any, payload: Any) -> Any:
        return rebuilt(target_context, payload)
