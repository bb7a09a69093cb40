"""Typed TOML files: sections that refuse unknown keys, and one clear sentence for what is wrong."""

import difflib
from collections.abc import Iterator
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError


class Section(BaseModel):
    """A section of a file: unknown keys, nan and infinity are refused; it cannot be changed."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


# What pydantic says of a Python type, in words of the file.
_EXPECTED = {
    "tuple_type": "expected a list, such as [1, 2, 3]; of sections, such as [{start=5}]",
    "list_type": "expected a list, such as [1, 2, 3]",
    "model_type": "expected a section of keys",
    "model_attributes_type": "expected a section of keys",
    "dict_type": "expected a section of keys",
    "too_long": "the list is too long",
    "too_short": "the list is too short",
}


def key_path(location: tuple[int | str, ...]) -> str:
    """`("fault", 0, "start")` as `fault[0].start`."""
    path = ""
    for part in location:
        path += f"[{part}]" if isinstance(part, int) else f".{part}" if path else part
    return path


def first_problem(error: ValidationError, model: type[BaseModel]) -> str:
    """The first problem of a validation: key, value, what was expected; and how many more.

    Args:
        error: of a validation.
        model: that was validated; its keys are what a misspelt one is compared with.
    """
    problems = error.errors(include_url=False)
    text = _sentence(problems[0], model)
    more = len(problems) - 1
    return f"{text} (and {more} more problem{'s' if more > 1 else ''})" if more else text


def _sentence(problem: Any, model: type[BaseModel]) -> str:
    location, kind = problem["loc"], problem["type"]
    key = key_path(location)
    if kind == "extra_forbidden":
        near = difflib.get_close_matches(str(location[-1]), list(_keys(model)), n=1)
        meant = f"; did you mean {near[0]!r}?" if near else ""
        return f"unknown key {key!r}{meant}"
    if kind == "missing":
        return f"{key}: missing, and it has no default"
    message = problem["msg"].removeprefix("Value error, ")
    if kind == "value_error":  # ours, which names its own key
        return message if message.startswith(key.split("[")[0]) or not key else f"{key}: {message}"
    message = _EXPECTED.get(kind, message[0].lower() + message[1:])
    value = problem["input"]
    shown = "" if isinstance(value, dict) or len(repr(value)) > 80 else f" (got {value!r})"
    return f"{key}: {message}{shown}" if key else f"{message}{shown}"


def _keys(model: type[BaseModel]) -> Iterator[str]:
    """Every key of a model and of the sections in it."""
    for name, field in model.model_fields.items():
        yield name
        for inner in (field.annotation, *getattr(field.annotation, "__args__", ())):
            if isinstance(inner, type) and issubclass(inner, BaseModel):
                yield from _keys(inner)
