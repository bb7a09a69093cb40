"""Overrides of a scenario as Python has them, written as the command line takes them."""

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np


def override_texts(values: Mapping[str, Any]) -> list[str]:
    """`{"fault[0].start": 12}` as `["fault[0].start=12"]`.

    Args:
        values: by dotted key; numbers, texts, lists and dicts, of NumPy too.

    Raises:
        TypeError: a value that no TOML file can hold.
    """
    return [f"{key}={_toml(value)}" for key, value in values.items()]


def _toml(value: Any) -> str:
    if isinstance(value, np.generic | np.ndarray):
        value = value.tolist()
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value)  # TOML's basic strings are JSON's
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{json.dumps(k)} = {_toml(v)}" for k, v in value.items()) + "}"
    if isinstance(value, Sequence):
        return "[" + ", ".join(map(_toml, value)) + "]"
    raise TypeError(f"set: {value!r} of type {type(value).__name__} cannot stand in a scenario")
