"""Dotted keys, such as `fault[0].start`: where they lead in the tables and arrays of a TOML document."""

import re
from collections.abc import Sequence
from typing import Any

from ftc_jsb.errors import ScenarioError
from ftc_jsb.toml_file import DEEPEST

_INDEX = re.compile(r"0*(\d{1,9})")


def path_of(key: str) -> tuple[str, ...]:
    """Names and indices along `key`: `fault[0].start` and `fault.0.start` are fault, 0, start."""
    return tuple(key.strip().replace("[", ".").replace("]", "").split("."))


def value_at(values: dict[str, Any], key: str) -> Any:
    """What stands at `key` in `values`; None where nothing does."""
    place: Any = values
    for part in path_of(key):
        if isinstance(place, dict):
            place = place.get(part)
        elif isinstance(place, list | tuple):
            index = _index(part, place)
            place = None if index is None else place[index]
        else:
            return None
    return place


def with_value(values: dict[str, Any], key: str, value: Any) -> dict[str, Any]:
    """`values` with `value` at `key`; tables that are not there yet are made.

    What stands beside the way is shared with `values`, which itself stays as it is; tuples on the way
    become lists.

    Raises:
        ScenarioError: the way leads through a value, or to an entry that an array has not, or has
            more than 32 parts.
    """
    changed = dict(values)
    place: Any = changed
    path = path_of(key)
    if len(path) > DEEPEST:
        raise ScenarioError(f"expected a key of {DEEPEST} parts at most")
    for depth, part in enumerate(path):
        selector = _selector(place, path[:depth], part)
        if depth == len(path) - 1:
            place[selector] = value
            break
        inside = place.get(selector, {}) if isinstance(place, dict) else place[selector]
        if not isinstance(inside, dict | list | tuple):
            raise ScenarioError(f"{'.'.join(path[: depth + 1])} is a value, not a section")
        place[selector] = dict(inside) if isinstance(inside, dict) else list(inside)
        place = place[selector]
    return changed


def _selector(place: dict[str, Any] | list[Any], way: Sequence[str], part: str) -> str | int:
    if isinstance(place, dict):
        return part
    index = _index(part, place)
    if index is None:
        raise ScenarioError(
            f"{'.'.join(way)} has {len(place)} entries; {part!r} is none of 0 to {len(place) - 1}"
        )
    return index


def _index(part: str, entries: Sequence[Any]) -> int | None:
    found = _INDEX.fullmatch(part)  # decimal digits only: '²' is a digit, and no number
    if found is None or int(found[1]) >= len(entries):
        return None
    return int(found[1])
