"""Code of the user's own is fenced in: what it raises is an error of its own, what it sets is set back.

It is not a sandbox: code that ends the process, or runs in threads of its own, is beyond it.
"""

import os
import signal
import sys
import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import numpy as np

LONGEST_SHOWN = 120  # characters


def said(error: BaseException) -> str:
    """What went wrong, with the kind of the error."""
    try:
        return f"{type(error).__name__}: {error}"
    except Exception:  # whatever its __str__ does
        return type(error).__name__


def shown(value: object) -> str:
    """A value as Python writes it, cut where it is long."""
    try:
        text = repr(value)
    except Exception:  # an int of more digits than Python writes; whatever its __repr__ does
        return f"a {type(value).__name__}"
    return text if len(text) <= LONGEST_SHOWN else f"{text[:LONGEST_SHOWN]}..."


@contextmanager
def fenced() -> Iterator[None]:
    """Sets back, after the block, what a user's code may have set for the whole process.

    Working folder, umask, environment, NumPy's and Python's warnings, signal handlers, recursion limit,
    import path and standard streams.
    """
    folder = Path.cwd()
    umask = os.umask(0o077)
    os.umask(umask)
    environment = dict(os.environ)
    handlers = _handlers()
    streams = (sys.stdin, sys.stdout, sys.stderr)
    path, recursion = sys.path[:], sys.getrecursionlimit()
    errors = np.geterr()
    try:
        with warnings.catch_warnings():
            yield
    finally:
        np.seterr(**errors)
        sys.stdin, sys.stdout, sys.stderr = streams
        sys.path[:] = path
        sys.setrecursionlimit(recursion)
        for number, handler in handlers.items():
            if signal.getsignal(number) is not handler:
                signal.signal(number, handler)
        if dict(os.environ) != environment:
            os.environ.clear()
            os.environ.update(environment)
        os.umask(umask)
        with suppress(OSError):  # removed meanwhile
            os.chdir(folder)


def _handlers() -> dict[int, Any]:
    """Of signals that Python can set again, which it can in the main thread only."""
    if threading.current_thread() is not threading.main_thread():
        return {}
    found = {number: signal.getsignal(number) for number in signal.valid_signals()}
    return {number: handler for number, handler in found.items() if handler is not None}
