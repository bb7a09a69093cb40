"""How flights are told apart in the charts: panel, colour and dash of each."""

from typing import NamedTuple

from ftc_jsb.report.flight_groups import Flights, by_scenario
from ftc_jsb.report.titles import loop_title, model_title
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.vocabulary.signals import SENSED

DASHES = ("solid", "dash", "dot", "dashdot", "longdash")
COLOURS = 6  # that the page's style sheet has


class Look(NamedTuple):
    """Where and how the lines of a flight are drawn."""

    panel: int
    colour: int
    dash: str


class Looks(NamedTuple):
    """Of all flights of a page."""

    panels: list[str]  # titles; one without a title where all flights share a panel
    by_label: dict[str, Look]


def looks(flights: Flights) -> Looks:
    """A colour for a model and a dash for a loop, in one panel; of noisy flights the other way round.

    Lines that swing faster than a dash cover each other: every model of a scenario has a panel of its own then,
    and the loops in it are told apart by colour.
    """
    apart = any(noisy(flight.scenario) for flight in flights.values())
    groups = by_scenario(flights)
    panels: dict[str, int] = {}
    colours: dict[tuple[str, str], int] = {}
    dashes: dict[str, int] = {}
    found = {}
    for name, members in groups.items():
        for label, flight in members.items():
            model, loop = model_title(flight.scenario), loop_title(flight.scenario)
            title = f"{name}: {model}" if len(groups) > 1 else model
            panel = panels.setdefault(title, len(panels)) if apart else 0
            coloured, dashed = (("", loop), title) if apart else ((name, model), loop)
            colour = colours.setdefault(coloured, len(colours)) % COLOURS
            dash = DASHES[dashes.setdefault(dashed, len(dashes)) % len(DASHES)]
            found[label] = Look(panel, colour, dash)
    return Looks(list(panels) or [""], found)


def noisy(scenario: Scenario) -> bool:
    """Whether turbulence, gusts or sensors make the lines of a flight swing."""
    wind, sensors = scenario.wind, scenario.sensors
    own = any(getattr(sensors, name) is not None for name in SENSED)
    return wind.turbulence != "none" or bool(wind.gust) or sensors.profile != "perfect" or own
