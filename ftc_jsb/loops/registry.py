"""The registry of outer loops: built in, installed by entry point, or a class of the user's own."""

import importlib
import sys
from collections.abc import Callable
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any, Protocol

import numpy.typing as npt

from ftc_jsb.control.protocol import LoopSetup, OuterLoop
from ftc_jsb.errors import LoopError
from ftc_jsb.loops.built_in import BUILT_IN, CompiledLoop
from ftc_jsb.loops.fence import said
from ftc_jsb.loops.python_loop import PythonLoop
from ftc_jsb.suggestion import did_you_mean

ENTRY_POINTS = "ftc_jsb.loops"


class RecordedLoop(Protocol):
    """A loop bound to a recording."""

    def step(self, i: int) -> None:
        """Read row `i` and write the commands of that sample there."""


def loop_names() -> dict[str, str]:
    """Name and description of every loop: built in, and installed by entry point."""
    names = {name: kind.meaning for name, kind in BUILT_IN.items()}
    for point in entry_points(group=ENTRY_POINTS):
        names[point.name] = f"installed: {point.value}"
    return names


def build_loop(setup: LoopSetup, model: npt.NDArray[Any], record: npt.NDArray[Any]) -> RecordedLoop:
    """The loop `setup.settings.name`, bound to a recording.

    Raises:
        LoopError: unknown, cannot be imported, or refuses its settings.
    """
    name = setup.settings.name
    if name in BUILT_IN:
        return CompiledLoop(setup, model, record)
    return PythonLoop(make_loop(setup), record)


def make_loop(setup: LoopSetup) -> OuterLoop:
    """A loop that is not built in, from its class.

    Raises:
        LoopError: unknown, cannot be imported, or refuses its settings.
    """
    name = setup.settings.name
    loop = find_loop(name)
    try:
        return loop(setup)
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        raise LoopError(f"loop {name!r} cannot be built: {said(error)}") from error


def find_loop(name: str) -> Callable[[LoopSetup], OuterLoop]:
    """Class of a loop that is not built in: an entry point, or `package.module:Class`.

    Modules are searched for in the working folder, too.

    Raises:
        LoopError: there is none.
    """
    for point in entry_points(group=ENTRY_POINTS, name=name):
        try:
            loaded: Callable[[LoopSetup], OuterLoop] = point.load()
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            raise LoopError(
                f"loop.name: {name!r}: {point.value} cannot be loaded: {said(error)}"
            ) from None
        return loaded
    module_name, colon, class_name = name.partition(":")
    if not colon or not module_name or not class_name:
        raise LoopError(
            f"loop.name: no loop {name!r}{did_you_mean(name, loop_names())}; "
            f"expected one of {', '.join(loop_names())}, "
            "or package.module:Class"
        )
    if str(Path.cwd()) not in sys.path:
        sys.path.append(str(Path.cwd()))
    try:
        module = importlib.import_module(module_name)
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # whatever a user's module does when it is imported
        raise LoopError(
            f"loop.name: {name!r}: cannot import {module_name!r}: {said(error)}"
        ) from None
    try:
        found: Callable[[LoopSetup], OuterLoop] = getattr(module, class_name)
    except AttributeError:
        raise LoopError(f"loop.name: {name!r}: {module_name!r} has no {class_name!r}") from None
    return found
