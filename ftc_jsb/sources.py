"""What a module is made from: its own source and that of every module of this package that it imports.

Caches are named after it, so that whatever is changed, what was made from it is made anew. Imports are
read from the text, which takes a hundredth of the time of parsing it.
"""

import hashlib
import os
import re
import sys
import time
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).parent
STARTED = time.time()  # [s], this process
_IMPORT = re.compile(
    rf"^\s*(?:from|import)\s+{PACKAGE.name}((?:\.\w+)*)(?:\s+import\s+(\([^)]*\)|.*))?",
    re.MULTILINE,
)
_BESIDE = re.compile(r"^\s*from\s+\.(\w*)\s+import\s+(\([^)]*\)|.*)", re.MULTILINE)


def source_digest(module: str) -> str:
    """SHA-256 of the sources that a module is made from.

    Args:
        module: its name, such as `ftc_jsb.control.law`.
    """
    digest = hashlib.sha256()
    for path in sources(module):
        digest.update(_contents(path))
    return digest.hexdigest()


def sources(module: str) -> list[Path]:
    """Files that a module is made from, sorted; imports inside functions count.

    Args:
        module: its name. Of one outside this package, which must have been imported, its own file and
            what it takes from files beside it and from this package; nothing if it has no file.
    """
    found: set[Path] = set()
    waiting = [_file_of(module)]
    while waiting:
        path = waiting.pop()
        if path is not None and path not in found:
            found.add(path)
            waiting.extend(_imported(path))
    return sorted(found)


def _file_of(module: str) -> Path | None:
    package, *parts = module.split(".")
    if package == PACKAGE.name:
        return _file(tuple(parts))
    file = getattr(sys.modules.get(module), "__file__", None)
    return None if file is None else Path(file)


@cache
def _contents(path: Path) -> bytes:
    """Contents of a file; of one of this package edited since this process began, contents of no other process.

    What runs here may be the file as it was before: nobody else shall find it under the name of the new one.
    """
    contents = path.read_bytes()
    if path.is_relative_to(PACKAGE) and path.stat().st_mtime > STARTED:
        contents += f"# edited under process {os.getpid()}, begun at {STARTED!r}\n".encode()
    return contents


@cache
def _imported(path: Path) -> list[Path]:
    """Files of this package, and beside it, that a file names in its imports."""
    files: list[Path | None] = []
    text = _contents(path).decode()
    for module, names in _BESIDE.findall(text):
        beside = [module] if module else re.findall(r"\w+", names)
        files += [path.with_name(f"{name}.py") for name in beside]
    for package, names in _IMPORT.findall(text):
        parts = tuple(package.split(".")[1:])
        files.append(_file(parts))
        files += [_file((*parts, name)) for name in re.findall(r"\w+", names)]
    return [file for file in files if file is not None and file.is_file()]


def _file(parts: tuple[str, ...]) -> Path | None:
    """File of a module of this package; None where the parts name something in a module."""
    place = PACKAGE.joinpath(*parts)
    if place.with_suffix(".py").is_file():
        return place.with_suffix(".py")
    if parts and (place / "__init__.py").is_file():
        return place / "__init__.py"
    return None
