"""`scenario`: a scenario file as a typed value that is edited by making another."""

import sys
from collections.abc import Mapping
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from ftc_jsb.api.overrides import override_texts
from ftc_jsb.atomic_file import write_text
from ftc_jsb.control.protocol import OuterLoop
from ftc_jsb.errors import LoopError, WriteError
from ftc_jsb.scenario import schema
from ftc_jsb.scenario.keys import value_at
from ftc_jsb.scenario.load import load_scenario, override_scenario, scenario_toml

LoopChoice = str | type[OuterLoop]


class Scenario(schema.Scenario):
    """A whole scenario; its fields are the keys of the file (docs/scenarios.md has their units)."""

    def edit(self, values: Mapping[str, Any]) -> "Scenario":
        """The same scenario with other values; this one stays as it is.

        Args:
            values: by dotted key, such as `{"fault[0].effectiveness": 0.5, "duration": 30}`.

        Raises:
            ScenarioError: no such key, or a value out of its range.
        """
        given = self.model_dump(mode="json", exclude_none=True)
        edited = override_scenario(given, override_texts(values), f"scenario {self.name!r}", "set")
        return Scenario.model_construct(**dict(edited))

    def __getitem__(self, key: str) -> Any:
        """The value at a dotted key, such as `"fault[0].start"`.

        Raises:
            KeyError: nothing stands there.
        """
        value = value_at(self.model_dump(), key)
        if value is None:
            raise KeyError(key)
        return value

    def to_toml(self, path: str | PathLike[str] | None = None, force: bool = False) -> str:
        """The scenario as TOML, defaults included; written to `path` where one is given.

        Raises:
            WriteError: the file exists and `force` is not given, or it cannot be written.
        """
        text = scenario_toml(self)
        if path is not None:
            if Path(path).exists() and not force:
                raise WriteError(fspath(path), "it exists; give another path, or force=True")
            write_text(Path(path), text)
        return text

    def __repr__(self) -> str:
        """One line."""
        return (
            f"<Scenario {self.name!r}: {self.duration:g} s, model {self.model}, "
            f"loop {self.loop.name}, faults: {len(self.fault)}>"
        )

    def __str__(self) -> str:
        """One line."""
        return repr(self)


def scenario(
    name: "str | PathLike[str] | schema.Scenario",
    *,
    set: Mapping[str, Any] | None = None,  # noqa: A002
) -> Scenario:
    """A scenario by name or path.

    Args:
        name: of a shipped scenario (`ftc-jsb list`), a path of a .toml file, or a scenario.
        set: values by dotted key that replace the file's.

    Raises:
        ScenarioError: with file, key and what was expected.
    """
    if isinstance(name, schema.Scenario):
        found = Scenario.model_construct(**dict(name))
    else:
        found = Scenario.model_construct(**dict(load_scenario(fspath(name))))
    return found.edit(set) if set else found


def flown_scenario(
    name: "str | PathLike[str] | schema.Scenario",
    model: str | None,
    loop: LoopChoice | None,
    values: Mapping[str, Any] | None,
) -> schema.Scenario:
    """What is flown: a scenario with another model, loop or values.

    Raises:
        UserError: no such scenario, key, value or loop.
    """
    changes = dict(values or {})
    if model is not None:
        changes["model"] = model
    if loop is not None:
        changes["loop.name"] = loop_name(loop)
    made = scenario(name, set=changes)
    return schema.Scenario.model_construct(**dict(made))


def loop_name(loop: LoopChoice) -> str:
    """Name of a loop, or `module:Class` of a class.

    Raises:
        LoopError: a class that cannot be found again by its name.
    """
    if isinstance(loop, str):
        return loop
    module, name = loop.__module__, loop.__qualname__
    if getattr(sys.modules.get(module), name, None) is not loop:
        raise LoopError(
            f"loop {name}: is not at the top of its module {module!r}; expected a class defined at the "
            "top of a module or notebook, which a recording can name"
        )
    return f"{module}:{name}"
