"""The table of the fault timeline: for each flight what happened first, of each kind of event."""

import math
from typing import Any

from markupsafe import Markup

from ftc_jsb.analysis.fault_timeline import (
    DECLARED,
    FAULT,
    GIVEN_UP,
    ISOLATED,
    LIMIT,
    LOST,
    SUSPECTED,
)
from ftc_jsb.report.flight_groups import Flights
from ftc_jsb.report.page.linked_numbers import linked_number
from ftc_jsb.report.page.section_tables import Cell, Document, PlainTable
from ftc_jsb.report.titles import limit_title

FOUND = (SUSPECTED, DECLARED, ISOLATED)  # by the loop: false before a fault
COLUMNS: dict[str, tuple[str, ...]] = {  # heading: its events
    "Sets in": (FAULT,),
    "Suspected": (SUSPECTED,),
    "Declared": (DECLARED,),
    "Isolated": (ISOLATED,),
    "Limit broken": (LIMIT,),
    "Given up": tuple(event for event, _ in GIVEN_UP.values()),
    "Control lost": (LOST,),
}


def timeline_table(
    flights: Flights, document: Document, titles: dict[str, str]
) -> PlainTable | None:
    """The first time of every event and cause; None where nothing happened in any flight."""
    if not any(document["flights"][label]["timeline"] for label in flights):
        return None
    rows: list[tuple[str, list[Cell]]] = []
    for label in flights:
        cells: list[Cell] = [_first(document, label, events) for events in COLUMNS.values()]
        rows.append((titles[label], cells))
    return PlainTable("", "Flight", list(COLUMNS), rows)


def _first(document: Document, label: str, events: tuple[str, ...]) -> Markup:
    """Every cause of these events with the first time of it; a dash without any.

    What the loop found before any fault had set in is told apart.
    """
    timeline = document["flights"][label]["timeline"]
    onset = min((s["from_s"] for s in timeline if s["event"] == FAULT), default=math.inf)
    said: dict[tuple[str, str, bool], Markup] = {}
    for index, stretch in enumerate(timeline):
        early = stretch["event"] in FOUND and stretch["from_s"] < onset
        key = (stretch["event"], stretch["what"], early)
        if stretch["event"] in events and key not in said:
            number = linked_number(document, ("flights", label, "timeline", index, "from_s"), 2)
            words = f"false: {cause(stretch)}" if early else cause(stretch)
            said[key] = Markup("{} {}\u202fs").format(words, number)
    return Markup("<br>").join(said.values()) if said else Markup("–")


def cause(stretch: dict[str, Any]) -> str:
    """What is said of a stretch beside its event: who, which limit, what was given up."""
    if stretch["event"] == LIMIT:
        return limit_title(stretch["what"])
    for event, _ in GIVEN_UP.values():
        if stretch["event"] == event:
            return event.removesuffix(" given up")
    return str(stretch["what"]).replace("_", " ")
