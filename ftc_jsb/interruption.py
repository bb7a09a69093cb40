"""Ctrl-C, SIGTERM and SIGHUP end what is being done in the same way: a `KeyboardInterrupt`, once it is saved.

`uninterrupted` holds them back where something would be lost; `interruptible`, inside it, lets them
through while what is flown so far can still be kept.
"""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

ENDING = ("SIGINT", "SIGTERM", "SIGHUP")


class _State:
    """Of this process."""

    held = 0  # depth of `uninterrupted`
    came = False  # a signal came while held


def _end(_number: int, _frame: FrameType | None) -> None:
    if _State.held:
        _State.came = True
    else:
        raise KeyboardInterrupt


@contextmanager
def ended_by_signals() -> Iterator[None]:
    """SIGTERM and SIGHUP raise `KeyboardInterrupt` as Ctrl-C does; whoever ignores one (nohup) goes on so."""
    with _handled(ENDING):
        yield


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Ctrl-C, and the other signals inside `ended_by_signals`, wait until the block is over.

    Elsewhere than in the main thread they do anyway.

    Raises:
        KeyboardInterrupt: after the block, if one came.
    """
    if not _in_main_thread():
        yield
        return
    with _handled(ENDING[:1]):
        _State.held += 1
        try:
            yield
        finally:
            _State.held -= 1
        _raise_if_came()


@contextmanager
def interruptible() -> Iterator[None]:
    """Inside `uninterrupted`: signals are let through, one that has come already at once."""
    if not _in_main_thread():
        yield
        return
    before, _State.held = _State.held, 0
    try:
        _raise_if_came()
        yield
    finally:
        _State.held = before


def _raise_if_came() -> None:
    if _State.came and not _State.held:
        _State.came = False
        raise KeyboardInterrupt


@contextmanager
def _handled(names: tuple[str, ...]) -> Iterator[None]:
    """Has `_end` handle signals that are not ignored."""
    before: dict[int, Any] = {}
    if _in_main_thread():
        for name in names:
            number = getattr(signal, name, None)  # a system may not have it
            if number is not None and signal.getsignal(number) not in (signal.SIG_IGN, _end, None):
                before[number] = signal.signal(number, _end)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _in_main_thread() -> bool:
    return threading.current_thread() is threading.main_thread()
