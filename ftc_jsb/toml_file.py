"""TOML as people write it, read in bounded time and memory: what no file of ours can hold is refused."""

import re
import tomllib
from pathlib import Path
from typing import Any

from ftc_jsb.bounded_file import UnreadableError, read_bounded_text

LARGEST = 16_000_000  # bytes: 10,000 breakpoints thrice are 1 million
DEEPEST = 32  # sections and lists inside one another; ours are 5
_INT64 = 2**63

# A key of many dotted parts takes tomllib time and memory as their square.
_PART = r"(?:[A-Za-z0-9_-]+|\"[^\"\n]*\"|'[^'\n]*')"
_MANY_PARTS = re.compile(rf"^[ \t\[{{]*(?:{_PART}[ \t]*\.[ \t]*){{{DEEPEST}}}", re.MULTILINE)
_INLINE_PARTS = re.compile(rf"[{{,][ \t]*(?:{_PART}[ \t]*\.[ \t]*){{{DEEPEST}}}")


NOT_TOML = "not TOML"  # what messages of a text begin with that breaks the rules of TOML


class TomlError(ValueError):
    """A text that cannot be used; the message says why, and does not name the file."""


def read_toml(path: Path) -> dict[str, Any]:
    """The contents of a TOML file.

    Raises:
        TomlError: it cannot be read, or as `parse_toml`.
    """
    return parse_toml(read_toml_text(path))


def read_toml_text(path: Path) -> str:
    """The text of a TOML file.

    Raises:
        TomlError: it cannot be read.
    """
    try:
        return read_bounded_text(path, LARGEST)
    except UnreadableError as error:
        raise TomlError(str(error)) from None


def parse_toml(text: str) -> dict[str, Any]:
    """The contents of a TOML text.

    Raises:
        TomlError: not TOML, or with numbers of more than 64 bits, keys of more than 32 parts or sections
            inside one another more than 32 deep.
    """
    if len(text) > LARGEST:
        raise TomlError(f"cannot be used: more than {LARGEST} characters")
    if _MANY_PARTS.search(text) or _INLINE_PARTS.search(text):
        raise TomlError(f"cannot be used: a key of more than {DEEPEST} parts")
    try:
        values = tomllib.loads(text)
    except RecursionError:
        raise TomlError(_TOO_DEEP) from None
    except ValueError as error:  # tomllib's own, and that of an integer of thousands of digits
        if not isinstance(error, tomllib.TOMLDecodeError):
            raise TomlError("cannot be used: a number of thousands of digits") from None
        raise TomlError(f"{NOT_TOML}: {error}") from None
    _check_values(values)
    return values


_TOO_DEEP = f"cannot be used: sections or lists more than {DEEPEST} deep"


def _check_values(values: dict[str, Any]) -> None:
    """See that nothing is too deep or too large for what reads it next."""
    layer: list[Any] = [values]
    for _ in range(DEEPEST):
        following: list[Any] = []
        for place in layer:
            for value in place.values() if isinstance(place, dict) else place:
                if isinstance(value, dict | list):
                    following.append(value)
                elif isinstance(value, int) and not -_INT64 <= value < _INT64:
                    raise TomlError("cannot be used: an integer of more than 64 bits")
        layer = following
    if layer:
        raise TomlError(_TOO_DEEP)
