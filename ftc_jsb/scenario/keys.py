"""Dotted keys of a file, such as `fault[0].start`, and what they name in nested values."""

from typing import Any

Part = str | int  # key of a section, or number in a list


def key_parts(key: str) -> tuple[Part, ...]:
    """`fault[0].start` as `("fault", 0, "start")`; the numbers are those written with the digits 0 to 9."""
    parts = key.strip().replace("[", ".").replace("]", "").split(".")
    return tuple(int(part) if part.isascii() and part.isdigit() else part for part in parts)


def value_at(values: Any, parts: tuple[Part, ...]) -> Any:
    """What a key names in nested dictionaries and lists.

    Raises:
        KeyError, IndexError, TypeError: it names nothing.
    """
    for part in parts:
        values = values[part]
    return values
