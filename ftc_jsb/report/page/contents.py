"""What stands on the page: every part of it, as the template takes it."""

import json
from typing import Any

import markupsafe

from ftc_jsb.analysis.fault_timeline import EVENTS
from ftc_jsb.analysis.filter_health import SIGMAS
from ftc_jsb.analysis.validity import ACCEPTED
from ftc_jsb.recording.provenance import machine, versions
from ftc_jsb.report.fault_times import fault_times
from ftc_jsb.report.findings import Findings
from ftc_jsb.report.flight_groups import Flights, by_scenario, scenario_differences
from ftc_jsb.report.page import envelope
from ftc_jsb.report.page.chart_series import Series
from ftc_jsb.report.page.charts import Chart, as_data, charts
from ftc_jsb.report.page.comparison_table import comparison_table
from ftc_jsb.report.page.first_screen import first_screen
from ftc_jsb.report.page.linked_files import scenario_text
from ftc_jsb.report.page.linked_numbers import LinkedNumber, linked_number
from ftc_jsb.report.page.panels import looks
from ftc_jsb.report.page.section_tables import (
    difference_tables,
    estimator_table,
    model_table,
    stability_table,
)
from ftc_jsb.report.page.timeline_table import cause, timeline_table
from ftc_jsb.report.titles import flight_titles


def page_contents(
    flights: Flights, findings: Findings, series: dict[str, Series], unread: tuple[str, ...]
) -> dict[str, Any]:
    """What the template `report.html` is filled with.

    Args:
        flights: at least one.
        findings: of these flights.
        series: behind the charts.
        unread: what is wrong with recordings that could not be read.
    """
    document = findings.document
    titles = flight_titles(flights)
    groups = by_scenario(flights)
    first = next(iter(flights.values()))
    drawn = charts(series, any(e["timeline"] for e in document["flights"].values()))
    look = looks(flights)
    return {
        "title": _title(flights),
        "description": first.scenario.description.strip() if len(groups) == 1 else "",
        "notices": [*unread, *_ended_early(flights, titles), *findings.problems],
        "screens": first_screen(flights, document),
        "accepted": ACCEPTED,
        "comparison": comparison_table(flights, document),
        "group_names": list(groups),
        "scenario_differences": scenario_differences(flights),
        "difference_tables": difference_tables(flights, document, titles),
        "model_table": model_table(flights, document, titles),
        "estimator_table": estimator_table(flights, document, titles),
        "stability_table": stability_table(flights, document, titles),
        "samples_per_point": _samples_per_point(document, titles),
        "charts": drawn,
        "panelled": len(look.panels) > 1,
        "flight_chips": [
            {**look.by_label[label]._asdict(), "title": titles[label]} for label in flights
        ],
        "timeline_table": timeline_table(flights, document, titles),
        "data": _data(flights, document, titles, series, drawn),
        "scenarios": [(name, scenario_text(members)) for name, members in groups.items()],
        "made": _made(flights),
    }


def _samples_per_point(
    document: dict[str, Any], titles: dict[str, str]
) -> list[tuple[LinkedNumber, str]]:
    """How much the charts are thinned, and which flights by so much."""
    by_every: dict[int, list[str]] = {}
    for label, every in document["samples_per_point"].items():
        by_every.setdefault(every, []).append(label)
    return [
        (
            linked_number(document, ("samples_per_point", labels[0]), 0),
            "; ".join(titles[k] for k in labels),
        )
        for labels in by_every.values()
    ]


def _data(
    flights: Flights,
    document: dict[str, Any],
    titles: dict[str, str],
    series: dict[str, Series],
    drawn: list[Chart],
) -> markupsafe.Markup:
    """Flights and charts as JSON inside the page; `</` must not end the script element."""
    groups = {
        label: number
        for number, members in enumerate(by_scenario(flights).values())
        for label in members
    }
    look = looks(flights)
    entries = [
        {
            "title": titles[label],
            "group": groups[label],
            "faults": fault_times(flight),
            **look.by_label[label]._asdict(),
            "timeline": [
                {**stretch, "what": cause(stretch)}
                for stretch in document["flights"][label]["timeline"]
            ],
            "columns": series[label].columns,
        }
        for label, flight in flights.items()
    ]
    found = {
        "flights": entries,
        "panels": look.panels,
        "charts": [as_data(chart) for chart in drawn],
        "outlines": envelope.as_data(envelope.outlines(flights)),
        "events": list(EVENTS),
        "sigmas": SIGMAS,
    }
    return markupsafe.Markup(json.dumps(found).replace("</", "<\\/"))


def _title(flights: Flights) -> str:
    first = next(iter(flights.values())).scenario
    names = list(by_scenario(flights))
    if len(names) == 1:
        return first.title or first.name
    return f"Flights of the scenarios {', '.join(names)}"


def _ended_early(flights: Flights, titles: dict[str, str]) -> list[str]:
    return [
        f"{titles[label]}: {flight.outcome.status}: {flight.outcome.reason}"
        for label, flight in flights.items()
        if flight.outcome.status != "complete"
    ]


def _made(flights: Flights) -> list[str]:
    """With what and where each flight was flown, and this page was made."""
    lines: dict[str, list[str]] = {}
    here = _provenance(versions(), machine())
    for label, flight in flights.items():
        made = flight.provenance
        line = here if made is None else _provenance(made.versions, made.machine)
        lines.setdefault(line, []).append(label)
    flown = [f"Flown ({', '.join(labels)}): {line}" for line, labels in lines.items()]
    return [*flown, f"This page: {here}"] if list(lines) != [here] else [f"Flown here: {here}"]


def _provenance(found: dict[str, str], where: str) -> str:
    packages = ", ".join(f"{name} {version}" for name, version in found.items())
    return f"{packages}; {where}"
