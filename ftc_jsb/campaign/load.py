"""Campaign files: found by name or path, validated with every dispersion, written with their scenarios."""

import json
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from ftc_jsb.bounded_file import is_file
from ftc_jsb.campaign.case import Bases, case_of, flights_of, scenario_of_case
from ftc_jsb.campaign.dispersion import Dispersion
from ftc_jsb.campaign.sampling import middle
from ftc_jsb.campaign.schema import Campaign
from ftc_jsb.errors import LoopError, ScenarioError
from ftc_jsb.loops.built_in import BUILT_IN
from ftc_jsb.loops.registry import find_loop
from ftc_jsb.resources import shipped
from ftc_jsb.scenario.load import (
    file_or_shipped,
    load_scenario,
    scenario_names,
    scenario_of,
    scenario_toml,
)
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.admissible_faults import refuse_unflyable
from ftc_jsb.toml_file import TomlError, read_toml
from ftc_jsb.typed_file import every_problem

FILE, SCENARIOS = "campaign.toml", "scenarios"  # in the folder of a campaign
_TRIALS = 64  # values of a choice, and cases, that are looked at before anything is flown


def campaign_names() -> list[str]:
    """Names of the shipped campaigns."""
    return sorted(path.stem for path in _shipped().glob("*.toml"))


def load_campaign(name: str) -> Bases:
    """Read and validate a campaign: its keys, its scenarios, and every dispersion at its edges.

    Args:
        name: path, or name of a shipped campaign.

    Raises:
        ScenarioError: with file, key and what was expected.
    """
    path = _path(name)
    try:
        values = read_toml(path)
        campaign = Campaign.model_validate_json(json.dumps(values, default=str), strict=True)
    except TomlError as error:
        raise ScenarioError(f"{path}: {error}") from None
    except ValidationError as error:
        raise ScenarioError(f"{path}: {every_problem(error, Campaign)}") from None
    scenarios = tuple(_base(path, entry) for entry in campaign.scenarios)
    bases = Bases(campaign, scenarios)
    _try_dispersions(bases, str(path))
    return bases


def write_campaign(bases: Bases, folder: Path) -> None:
    """Write `campaign.toml` and its scenarios, so that `load_campaign` finds all of it there."""
    import tomli_w

    place = folder / SCENARIOS
    place.mkdir(exist_ok=True)
    names = []
    for index, scenario in enumerate(bases.scenarios):
        name = f"{index}-{scenario.name}.toml"
        (place / name).write_text(scenario_toml(scenario), encoding="utf-8")
        names.append(f"{SCENARIOS}/{name}")
    campaign = bases.campaign.model_copy(update={"scenarios": tuple(names)})
    document = campaign.model_dump(mode="json", exclude_none=True)
    (folder / FILE).write_text(tomli_w.dumps(document), encoding="utf-8")


def packed(bases: Bases) -> str:
    """A campaign as text, for a worker that has none of its files."""
    scenarios = [
        scenario.model_dump(mode="json", exclude_none=True) for scenario in bases.scenarios
    ]
    campaign = bases.campaign.model_dump(mode="json", exclude_none=True)
    return json.dumps({"campaign": campaign, "scenarios": scenarios})


def unpacked(text: str) -> Bases:
    """The campaign of `packed`."""
    values = json.loads(text)
    campaign = Campaign.model_validate_json(json.dumps(values["campaign"]), strict=True)
    found = [
        Scenario.model_validate_json(json.dumps(entry), strict=True)
        for entry in values["scenarios"]
    ]
    return Bases(campaign, tuple(found))


def _shipped() -> Path:
    return shipped("scenarios") / "campaigns"


def _path(name: str) -> Path:
    return file_or_shipped(name, _shipped(), "campaign")


def _base(path: Path, entry: str) -> Scenario:
    """A scenario that a campaign names: a shipped one, or a path beside the campaign's file."""
    beside = path.parent / entry
    try:
        if entry in scenario_names() and not entry.endswith(".toml"):
            return load_scenario(entry)
        if not is_file(beside):
            known = ", ".join(scenario_names())
            raise ScenarioError(
                f"no scenario {entry!r}; expected one of {known}, or a path beside the campaign"
            )
        return scenario_of(read_toml(beside), str(beside))
    except TomlError as error:
        raise ScenarioError(f"{path}: scenarios: {beside}: {error}") from None
    except ScenarioError as error:
        raise ScenarioError(f"{path}: scenarios: {error}") from None


def _try_dispersions(bases: Bases, source: str) -> None:
    """See that overrides, one dispersion after another, and the first cases make scenarios that fly."""
    campaign = bases.campaign
    for loop in campaign.loops:
        if loop not in BUILT_IN:
            try:
                find_loop(loop)
            except LoopError as error:
                raise LoopError(f"{source}: loops: {error}") from None
    count = len(bases.scenarios)
    starts = [[middle(None, k, count)] for k in range(count)] if count > 1 else [[]]
    for start in starts:
        _try(_with(bases, ()), 0, start, f"{source}: overrides")
        for index, dispersion in enumerate(campaign.dispersion):
            part = _with(bases, campaign.dispersion[: index + 1])
            for unit in _edges(dispersion):
                _try(part, 0, [*start, *[0.5] * index, unit], f"{source}: dispersion[{index}]")
    for number in range(min(campaign.count, _TRIALS)):
        _try(bases, number, None, f"{source}: case {number}")


def _with(bases: Bases, dispersions: tuple[Dispersion, ...]) -> Bases:
    return bases._replace(campaign=bases.campaign.model_copy(update={"dispersion": dispersions}))


def _edges(dispersion: Dispersion) -> list[float]:
    """Coordinates at which a dispersion is tried: near its ends, or every value of a choice."""
    count = min(len(dispersion.values or ()), _TRIALS)
    return [middle(dispersion.weights, k, count) for k in range(count)] or [0.001, 0.5, 0.999]


def _try(bases: Bases, number: int, point: list[float] | None, where: str) -> None:
    try:
        case = case_of(bases, number, point)
        for model, loop in flights_of(bases)[:: len(bases.campaign.loops)]:
            refuse_unflyable(scenario_of_case(case, model, loop))
    except ScenarioError as error:
        said = str(error).removeprefix(f"case {number}: ")
        raise ScenarioError(f"{where}: {said}") from None


def values_of(bases: Bases) -> dict[str, Any]:
    """All that decides what a campaign flies, to compare two by."""
    return dict(json.loads(packed(bases)))
