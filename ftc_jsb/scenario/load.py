"""Scenario files: found by name or path, overridden from the command line, validated, written out."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from ftc_jsb.bounded_file import is_file, is_folder
from ftc_jsb.errors import ScenarioError
from ftc_jsb.resources import aircraft_names, shipped
from ftc_jsb.scenario.keys import with_value
from ftc_jsb.scenario.schema import DESCRIPTION_LENGTH, TITLE_LENGTH, Scenario
from ftc_jsb.suggestion import did_you_mean
from ftc_jsb.toml_file import NOT_TOML, TomlError, parse_toml, read_toml
from ftc_jsb.typed_file import every_problem

_NOT_TOLD = (
    "model",
    "loop.name",
    "compare.models",
    "compare.loops",
    "title",
    "description",
    "name",
)


def scenario_names() -> list[str]:
    """Names of the shipped scenarios."""
    return sorted(path.stem for path in shipped("scenarios").glob("*.toml"))


def scenario_path(name: str) -> Path:
    """Path of a scenario given as a path or as the name of a shipped one.

    Raises:
        ScenarioError: neither exists.
    """
    return file_or_shipped(name, shipped("scenarios"), "scenario")


def file_or_shipped(name: str, folder: Path, kind: str) -> Path:
    """Path of a .toml file given as a path or as the name of one in a folder that is shipped.

    Args:
        name: as given.
        folder: of the shipped ones.
        kind: what it is, for messages.

    Raises:
        ScenarioError: neither exists.
    """
    path = Path(name)
    candidate = folder / f"{name}.toml"
    if path.suffix != ".toml" and path.name == name and is_file(candidate):
        return candidate  # whatever the working folder has of that name
    if is_file(path):
        return path
    if is_folder(path):
        raise ScenarioError(f"{name}: is a folder; expected the path of a {kind} (.toml)")
    if path.suffix == ".toml" or path.name != name:
        raise ScenarioError(f"{name}: no such file; expected the path of a {kind} (.toml)")
    known = sorted(each.stem for each in folder.glob("*.toml"))
    aircraft = next((each for each in aircraft_names() if each.lower() == name.lower()), None)
    nearest = did_you_mean(name, known)
    if aircraft is not None and name.lower() not in known:
        nearest = f" ({name} is an aircraft: fly a scenario with --set aircraft.name={aircraft})"
    raise ScenarioError(
        f"no {kind} {name!r}{nearest}; shipped are {', '.join(known)}; "
        "or give the path of a .toml file"
    )


def load_scenario(name: str, overrides: Sequence[str] = ()) -> Scenario:
    """Read, override and validate a scenario.

    Args:
        name: path, or name of a shipped scenario.
        overrides: `key=value` with dotted keys (`loop.gains=[2,1,1]`, `fault[0].start=10`); values
            are TOML, a bare word is text.

    Raises:
        ScenarioError: with file, key and what was expected.
    """
    path = scenario_path(name)
    try:
        values = read_toml(path)
    except TomlError as error:
        raise ScenarioError(f"{path}: {error}") from None
    scenario = scenario_of(values, str(path))
    return override_scenario(values, overrides, str(path)) if overrides else scenario


def override_scenario(
    values: dict[str, Any], overrides: Sequence[str], source: str, option: str = "--set"
) -> Scenario:
    """Scenario of the contents of a file, overridden.

    Args:
        values: contents of a file that is valid.
        overrides: as `load_scenario` takes them.
        source: names the file in messages.
        option: names the overrides in messages.

    Raises:
        ScenarioError: an override cannot be read, or makes no scenario.
    """
    for override in overrides:
        values = _overridden(values, override, option)
    values = _told(values, overrides)
    try:
        return _validated(values)
    except ValidationError as error:
        raise ScenarioError(f"{option} on {source}: {every_problem(error, Scenario)}") from None


def parse_scenario(text: str, source: str) -> Scenario:
    """Scenario of a TOML text; `source` names it in messages.

    Raises:
        ScenarioError: not TOML, or not a scenario.
    """
    try:
        values = parse_toml(text)
    except TomlError as error:
        raise ScenarioError(f"{source}: {error}") from None
    return scenario_of(values, source)


def scenario_of(values: dict[str, Any], source: str) -> Scenario:
    """Scenario of the contents of a file; `source` names it in messages.

    Raises:
        ScenarioError: not a scenario.
    """
    try:
        return _validated(values)
    except ValidationError as error:
        raise ScenarioError(f"{source}: {every_problem(error, Scenario)}") from None


def scenario_toml(scenario: Scenario) -> str:
    """`scenario` as TOML, defaults included: what a recording carries, and what it is flown from."""
    import tomli_w

    return tomli_w.dumps(scenario.model_dump(mode="json", exclude_none=True))


def _validated(values: dict[str, Any]) -> Scenario:
    # Strict, by way of JSON: a text is no number, but an array may be a tuple.
    return Scenario.model_validate_json(json.dumps(values, default=str), strict=True)


def _told(values: dict[str, Any], overrides: Sequence[str]) -> dict[str, Any]:
    """Title and description say what of the file was changed: what they tell may be overtaken."""
    changes = [text for text in overrides if text.partition("=")[0].strip() not in _NOT_TOLD]
    title, description = values.get("title", ""), values.get("description", "")
    if not changes or not isinstance(title, str) or not isinstance(description, str):
        return values
    said = f"changed: {', '.join(changes)}"
    told = f"{title or values.get('name', '')} ({said})"
    if len(told) > TITLE_LENGTH:
        told = f"{title[: TITLE_LENGTH - 30]} (changed in {len(changes)} keys)"
    note = f"Flown otherwise than the file has it, {said}. The file says:"
    room = DESCRIPTION_LENGTH - len(description) - 1
    return {**values, "title": told, "description": f"{note[:room]}\n{description.strip()}"}


def _overridden(values: dict[str, Any], override: str, option: str) -> dict[str, Any]:
    key, equals, text = override.partition("=")
    if not equals or not key.strip():
        raise ScenarioError(
            f"{option} {override!r}: expected KEY=VALUE, such as loop.trim_filter=20"
        )
    try:
        value = parse_toml(f"value = {text}")["value"]
    except TomlError as error:
        if not str(error).startswith(NOT_TOML):
            raise ScenarioError(f"{option} {key.strip()[:80]}: {error}") from None
        value = text.strip()
    try:
        return with_value(values, key, value)
    except ScenarioError as error:
        raise ScenarioError(f"{option} {key[:80]}: {error}") from None
