"""What a module is made from: its own source and that of every module of this package that it imports.

Caches are named after it, so that whatever is changed, what was made from it is made anew.
"""

import hashlib
import re
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).parent
_IMPORT = re.compile(rf"^\s*(?:from|import)\s+{PACKAGE.name}((?:\.\w+)+)", re.MULTILINE)
_NAMES = re.compile(
    rf"^\s*from\s+{PACKAGE.name}((?:\.\w+)*)\s+import\s+\(?([\w\s,]+)", re.MULTILINE
)


def source_digest(module: str) -> str:
    """SHA-256 of the sources that a module is made from, imports inside functions included.

    Args:
        module: its name, such as `ftc_jsb.control.law`. A module outside this package is its file alone
            as far as this package goes: "" gives the digest of nothing.
    """
    digest = hashlib.sha256()
    for path in sorted(_closure(module)):
        digest.update(_contents(path))
    return digest.hexdigest()


def sources(module: str) -> list[Path]:
    """Files that a module is made from, sorted."""
    return sorted(_closure(module))


def _closure(module: str) -> set[Path]:
    found: set[Path] = set()
    waiting = [_file(module.split(".")[1:])]
    while waiting:
        path = waiting.pop()
        if path is not None and path not in found:
            found.add(path)
            waiting.extend(_imported(path))
    return found


@cache
def _contents(path: Path) -> bytes:
    return path.read_bytes()


@cache
def _imported(path: Path) -> tuple[Path, ...]:
    """Files of this package that a file names in its imports."""
    text = _contents(path).decode()
    named = [match[1:].split(".") for match in _IMPORT.findall(text)]
    for package, names in _NAMES.findall(text):  # `from ftc_jsb.theory import law` is a module, too
        within = [part for part in package.split(".") if part]
        named += [[*within, name.split()[0]] for name in names.split(",") if name.strip()]
    return tuple(file for parts in named if (file := _file(parts)) is not None)


def _file(parts: list[str]) -> Path | None:
    """File of a module of this package; None where the parts name something in a module."""
    place = PACKAGE.joinpath(*parts)
    if place.with_suffix(".py").is_file():
        return place.with_suffix(".py")
    if parts and (place / "__init__.py").is_file():
        return place / "__init__.py"
    return None
