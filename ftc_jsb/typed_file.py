"""Typed TOML files: sections that refuse unknown keys, and one clear sentence for what is wrong."""

import re
from collections.abc import Iterator
from typing import Any, get_args

from pydantic import BaseModel, ConfigDict, ValidationError

from ftc_jsb.suggestion import meant


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
    said = _sentences(error, model)
    more = len(said) - 1
    return f"{said[0]} (and {more} more problem{'s' if more > 1 else ''})" if more else said[0]


def every_problem(error: ValidationError, model: type[BaseModel]) -> str:
    """Every problem of a validation, each on its own line where there are several.

    Args:
        error: of a validation.
        model: that was validated; its keys are what a misspelt one is compared with.
    """
    said = _sentences(error, model)
    return said[0] if len(said) == 1 else "\n  ".join([f"{len(said)} problems", *said])


def _sentences(error: ValidationError, model: type[BaseModel]) -> list[str]:
    found = error.errors(include_url=False)
    return list(dict.fromkeys(_sentence(problem, model) for problem in found))


def _sentence(problem: Any, model: type[BaseModel]) -> str:
    location, kind = problem["loc"], problem["type"]
    key = key_path(location)
    if kind == "extra_forbidden":
        here = _section(model, location[:-1]).model_fields
        near = meant(str(location[-1]), here, _keys(model))
        return f"unknown key {key!r}" + (f"; did you mean {near!r}?" if near else "")
    if kind == "missing":
        return f"{key}: missing, and it has no default"
    message = problem["msg"].removeprefix("Value error, ")
    if kind == "value_error":  # ours, which names its own key
        return message if message.startswith(key.split("[")[0]) or not key else f"{key}: {message}"
    message = _EXPECTED.get(kind, message[0].lower() + message[1:])
    value = problem["input"]
    if kind == "float_type" and isinstance(value, str) and _QUANTITY.fullmatch(value):
        message = f"expected a number without a unit{_in_our_units(value)}"
    shown = "" if isinstance(value, dict) or len(repr(value)) > 80 else f" (got {value!r})"
    return f"{key}: {message}{shown}" if key else f"{message}{shown}"


_UNITS = {  # how many of the unit that our files take
    "kt": (1852.0 / 3600.0, "m/s"), "kts": (1852.0 / 3600.0, "m/s"), "km/h": (1.0 / 3.6, "m/s"),
    "mph": (0.44704, "m/s"), "m/s": (1.0, "m/s"), "ft/s": (0.3048, "m/s"), "fps": (0.3048, "m/s"),
    "ft": (0.3048, "m"), "m": (1.0, "m"), "km": (1000.0, "m"), "nm": (1852.0, "m"), "s": (1.0, "s"),
    "min": (60.0, "s"), "ms": (0.001, "s"), "deg": (1.0, "deg"), "rad": (57.29577951308232, "deg"),
    "%": (0.01, "of 1"), "hz": (1.0, "Hz"),
}  # fmt: skip
_QUANTITY = re.compile(r"\s*([-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?)\s*([A-Za-z/%]+)\s*")


def _in_our_units(text: str) -> str:
    """`: 600 kt are 308.667 m/s`, if it is a number with a unit that is known."""
    found = _QUANTITY.fullmatch(text)
    unit = _UNITS.get(found[2].lower()) if found else None
    if found is None or unit is None:
        return ""
    return f": {found[1]} {found[2]} are {float(found[1]) * unit[0]:.6g} {unit[1]}"


def key_paths(model: type[BaseModel], before: str = "") -> Iterator[str]:
    """Every key of a file as `--set` takes it, such as `fault[0].start`."""
    for name, field in model.model_fields.items():
        section = _model_in(field.annotation)
        if section is None:
            yield f"{before}{name}"
        else:
            several = "[0]" if "tuple" in str(field.annotation) else ""
            yield from key_paths(section, f"{before}{name}{several}.")


def _section(model: type[BaseModel], location: tuple[int | str, ...]) -> type[BaseModel]:
    """The section that a location leads to; as far as it leads."""
    for part in location:
        field = model.model_fields.get(str(part))
        inside = None if field is None else _model_in(field.annotation)
        model = model if inside is None else inside
    return model


def _model_in(annotation: Any) -> type[BaseModel] | None:
    """The section in `Section`, `Section | None` or `tuple[Section, ...]`."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    found = (_model_in(part) for part in get_args(annotation))
    return next((section for section in found if section is not None), None)


def _keys(model: type[BaseModel]) -> Iterator[str]:
    """Every key of a model and of the sections in it."""
    for name, field in model.model_fields.items():
        yield name
        section = _model_in(field.annotation)
        if section is not None:
            yield from _keys(section)
