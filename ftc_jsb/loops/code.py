"""Loops that are Python code of the user's own: a data file names them, and only the user has them run."""

import sys
from collections.abc import Iterable, Sequence
from importlib.machinery import PathFinder
from pathlib import Path

from ftc_jsb.errors import LoopError


def is_code(name: str) -> bool:
    """Whether a loop is `package.module:Class`; built-in and installed ones have plain names."""
    return ":" in name


def imported_from(name: str) -> str:
    """What the import of a loop's module would run first: a file or folder, found without running anything."""
    package = name.partition(":")[0].partition(".")[0]
    spec = PathFinder.find_spec(package, [*sys.path, str(Path.cwd())]) if package else None
    if spec is None:
        return f"{package!r}, which is nowhere to be found"
    return str(spec.origin or next(iter(spec.submodule_search_locations or ()), package))


def refuse_code(loops: Iterable[str], source: str, typed: Sequence[str]) -> None:
    """See that a scenario or a recording names no code that the user has not asked for.

    Args:
        loops: that would be flown.
        source: the file that names them.
        typed: what the user typed; a loop that is named there is asked for.

    Raises:
        LoopError: there is code; says what would be imported.
    """
    for name in loops:
        if is_code(name) and not any(name in text for text in typed):
            raise LoopError(
                f"{source}: the loop {name!r} is Python code: {imported_from(name)}; a data file does "
                "not run code unasked: --allow-code lets it"
            )
