"""JSON Schema of our TOML files, by which editors complete keys, check values and show what they mean."""

import inspect
import re
from typing import Any

from pydantic import BaseModel

_DIALECT = "https://json-schema.org/draft/2020-12/schema"
_COMMENTED = re.compile(r"^    (\w+): .*#\s*(.+?)\s*$", re.MULTILINE)


def json_schema(model: type[BaseModel], title: str) -> dict[str, Any]:
    """The schema of a file; a key's description is the comment on its line in the model, with its unit.

    Args:
        model: of the whole file.
        title: of the schema.
    """
    schema = model.model_json_schema()
    for section in (model, *_sections(model)):
        where = schema if section is model else schema["$defs"][section.__name__]
        for name, comment in _comments(section).items():
            where["properties"][name]["description"] = comment
    schema |= {"$schema": _DIALECT, "title": title}
    return schema


def _sections(model: type[BaseModel], found: dict[str, type[BaseModel]] | None = None) -> Any:
    """Every section below a model, once."""
    found = {} if found is None else found
    for field in model.model_fields.values():
        waiting: list[Any] = [field.annotation]
        while waiting:
            part = waiting.pop()
            if (
                isinstance(part, type)
                and issubclass(part, BaseModel)
                and part.__name__ not in found
            ):
                found[part.__name__] = part
                _sections(part, found)
            waiting.extend(getattr(part, "__args__", ()))
    return found.values()


def _comments(model: type[BaseModel]) -> dict[str, str]:
    """Comments on the lines of the fields of a model."""
    source = inspect.getsource(model)
    return {name: text for name, text in _COMMENTED.findall(source) if name in model.model_fields}
