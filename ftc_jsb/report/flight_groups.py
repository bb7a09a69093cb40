"""Which flights belong together: same scenario, same model, same loop; and in what scenarios differ."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from ftc_jsb.recording.flight import Flight
from ftc_jsb.scenario.load import scenario_toml
from ftc_jsb.scenario.schema import Compare, Scenario

Flights = Mapping[str, Flight]


class ScenarioDifference(NamedTuple):
    """A key of the scenario file that is not the same in every group."""

    key: str
    values: list[str]  # one a group; a dash where it is not set


def by_scenario(flights: Flights) -> dict[str, dict[str, Flight]]:
    """Flights of one scenario each, by its name; models and loops of one scenario are together.

    Scenarios of one name that differ in anything else are numbered: "paper", "paper (2)".
    """
    names: dict[str, str] = {}  # by text
    groups: dict[str, dict[str, Flight]] = {}
    for label, flight in flights.items():
        text = scenario_toml(plain(flight.scenario))
        if text not in names:
            name, number = flight.scenario.name, 1
            while name in names.values():
                number += 1
                name = f"{flight.scenario.name} ({number})"
            names[text] = name
        groups.setdefault(names[text], {})[label] = flight
    return groups


def plain(scenario: Scenario) -> Scenario:
    """A scenario without what differs between the flights of one comparison."""
    loop = scenario.loop.model_copy(update={"name": "ftc"})
    same = {"model": "paper", "loop": loop, "compare": Compare(), "title": "", "description": ""}
    return scenario.model_copy(update=same)


def flown_scenario(members: Mapping[str, Flight]) -> Scenario:
    """The scenario of flights that share one: `fly` flies the first of them again, `compare` all.

    Args:
        members: at least one, of one group of `by_scenario`.
    """
    first = next(iter(members.values())).scenario
    models = tuple(dict.fromkeys(flight.scenario.model for flight in members.values()))
    loops = tuple(dict.fromkeys(flight.scenario.loop.name for flight in members.values()))
    compared = first.compare.model_copy(update={"models": models, "loops": loops})
    return first.model_copy(update={"compare": compared})


def model_pairs(flights: Flights) -> list[tuple[str, str]]:
    """Labels of (point mass, JSBSim) flights of the same scenario and loop."""
    pairs = []
    for members in by_scenario(flights).values():
        six_dof = {
            flight.scenario.loop.name: label
            for label, flight in members.items()
            if flight.scenario.model == "jsbsim"
        }
        pairs += [
            (label, six_dof[flight.scenario.loop.name])
            for label, flight in members.items()
            if flight.scenario.model in ("paper", "identified")
            and flight.scenario.loop.name in six_dof
        ]
    return pairs


def loop_pairs(flights: Flights) -> list[tuple[str, str]]:
    """Labels of flights with FTC, and of the same scenario and model without."""
    pairs = []
    for members in by_scenario(flights).values():
        by_kind = {(f.scenario.model, f.scenario.loop.name): label for label, f in members.items()}
        for (model, loop), label in by_kind.items():
            if loop == "ftc" and (model, "no-ftc") in by_kind:
                pairs.append((label, by_kind[model, "no-ftc"]))
    return pairs


def scenario_differences(flights: Flights) -> list[ScenarioDifference]:
    """The keys in which the scenarios of these flights differ, in the order of the file."""
    keys: dict[str, None] = {}
    settings = []
    for members in by_scenario(flights).values():
        scenario = plain(next(iter(members.values())).scenario)
        settings.append(_flat(scenario.model_dump(mode="json", exclude_none=True)))
        keys |= dict.fromkeys(settings[-1])
    return [
        ScenarioDifference(key, [setting.get(key, "–") for setting in settings])
        for key in keys
        if key not in ("name", "title", "description")
        and len({setting.get(key) for setting in settings}) > 1
    ]


def _flat(value: Any, key: str = "") -> dict[str, str]:
    """Dotted keys as in the scenario file; a list of numbers or of points is one value."""
    if isinstance(value, dict):
        parts = ((f"{key}.{name}" if key else name, part) for name, part in value.items())
    elif isinstance(value, list) and value and isinstance(value[0], dict):
        parts = ((f"{key}[{number}]", part) for number, part in enumerate(value))
    else:
        return {key: str(value)}
    return {name: text for at, part in parts for name, text in _flat(part, at).items()}
