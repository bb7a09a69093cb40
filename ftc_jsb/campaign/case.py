"""Case `number` of a campaign: its drawn values and the scenarios that it flies. Pure and cheap."""

from collections.abc import Sequence
from typing import Any, NamedTuple

from pydantic import ValidationError

from ftc_jsb.campaign.dispersion import Dispersion, is_number
from ftc_jsb.campaign.manoeuvre import Manoeuvre, breakpoints
from ftc_jsb.campaign.sampling import drawn_seed, unit_point
from ftc_jsb.campaign.schema import Campaign
from ftc_jsb.errors import ScenarioError
from ftc_jsb.scenario.keys import path_of, value_at, with_value
from ftc_jsb.scenario.load import scenario_of
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.typed_file import first_problem

Values = dict[str, Any]
_MANOEUVRE = "manoeuvre"


class Bases(NamedTuple):
    """A campaign and the scenarios that it starts from."""

    campaign: Campaign
    scenarios: tuple[Scenario, ...]


class Case(NamedTuple):
    """What case `number` is."""

    number: int
    unit: tuple[float, ...]  # its coordinates in the unit cube
    parameters: dict[str, Any]  # drawn values by key; None where one does not apply
    values: Values  # of its scenario, but for model and loop


def case_of(bases: Bases, number: int, unit: Sequence[float] | None = None) -> Case:
    """Case `number`; at another point of the unit cube where `unit` says so.

    Raises:
        ScenarioError: a key that leads nowhere.
    """
    campaign = bases.campaign
    point = unit_point(campaign, number) if unit is None else unit
    base, coordinates = _scenario_at(bases, tuple(map(float, point)))
    values: Values = base.model_dump(mode="json", exclude_none=True)
    parameters: dict[str, Any] = {"scenario": base.name}
    for key, value in campaign.overrides.items():
        values = with_value(values, key, value)
    if campaign.vary_seed:
        values["seed"] = parameters["seed"] = drawn_seed(campaign, number)
    if campaign.manoeuvre is not None:
        values[_MANOEUVRE] = campaign.manoeuvre.model_dump()
    for dispersion, coordinate in zip(campaign.dispersion, coordinates, strict=True):
        parameters.setdefault(dispersion.parameter, None)
        if _applies(dispersion, values):
            values = _dispersed(dispersion, coordinate, values)
            parameters[dispersion.parameter] = dispersion.shown(coordinate)
    return Case(number, tuple(map(float, point)), parameters, _with_references(values))


def scenario_of_case(case: Case, model: str | None, loop: str) -> Scenario:
    """The scenario that a model and a loop fly in a case.

    Args:
        case: of `case_of`.
        model: None for the scenario's own.
        loop: its name.

    Raises:
        ScenarioError: the drawn values make no valid scenario.
    """
    values = with_value(case.values, "loop.name", loop)
    if model is not None:
        values["model"] = model
    return scenario_of(values, f"case {case.number}")


def flights_of(bases: Bases) -> list[tuple[str | None, str]]:
    """(model, loop) of every flight of a case."""
    models: tuple[str | None, ...] = bases.campaign.models or (None,)
    return [(model, loop) for model in models for loop in bases.campaign.loops]


def _scenario_at(bases: Bases, point: tuple[float, ...]) -> tuple[Scenario, tuple[float, ...]]:
    """The scenario at a point, and the coordinates of the dispersions."""
    count = len(bases.scenarios)
    if count == 1:
        return bases.scenarios[0], point
    return bases.scenarios[min(int(point[0] * count), count - 1)], point[1:]


def _applies(dispersion: Dispersion, values: Values) -> bool:
    return all(value_at(values, key) in wanted for key, wanted in dispersion.when.items())


def _dispersed(dispersion: Dispersion, unit: float, values: Values) -> Values:
    drawn = dispersion.value(unit)
    for key in dispersion.keys:
        value = drawn
        if dispersion.apply != "replace":
            before = value_at(values, key)
            if not is_number(before):
                raise ScenarioError(f"{key}: has no number to {dispersion.apply} (got {before!r})")
            value = before * drawn if dispersion.apply == "scale" else before + drawn
        if path_of(key)[0] == _MANOEUVRE and _MANOEUVRE not in values:
            raise ScenarioError(f"{key}: the campaign has no section [manoeuvre]")
        values = with_value(values, key, value)
    return values


def _with_references(values: Values) -> Values:
    """`values` with the references of the manoeuvre, if there is one."""
    if _MANOEUVRE not in values:
        return values
    try:
        manoeuvre = Manoeuvre.model_validate(values[_MANOEUVRE])
    except ValidationError as error:
        raise ScenarioError(f"{_MANOEUVRE}.{first_problem(error, Manoeuvre)}") from None
    made = breakpoints(manoeuvre, values["initial"])
    flown = {key: value for key, value in values.items() if key != _MANOEUVRE}
    return flown | {"reference": flown["reference"] | made}
