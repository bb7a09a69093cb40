"""The report: one self-contained HTML file, its figures, and the numbers beside it."""

import json
from collections.abc import Sequence
from importlib import resources
from pathlib import Path
from typing import Any

import jinja2
import markupsafe

from ftc_jsb.analysis.validity import ACCEPTED
from ftc_jsb.errors import RecordingError
from ftc_jsb.recording.provenance import machine, versions
from ftc_jsb.report import display_names as words
from ftc_jsb.report import section_tables as tables
from ftc_jsb.report.chart_series import Series, flight_series
from ftc_jsb.report.charts import as_data, charts
from ftc_jsb.report.comparison_table import result_table
from ftc_jsb.report.fault_marks import fault_times
from ftc_jsb.report.figures.draw import draw_all
from ftc_jsb.report.figures.style import FORMATS
from ftc_jsb.report.findings import Findings, Flights, find
from ftc_jsb.report.flight_groups import by_scenario, plain, scenario_differences
from ftc_jsb.report.margins_files import KnownMargins
from ftc_jsb.report.quoted_numbers import Quote, quote
from ftc_jsb.report.summary import first_screen
from ftc_jsb.runs.metrics_file import write_metrics
from ftc_jsb.scenario.load import scenario_toml

DASHES = ("solid", "dash", "dot", "dashdot", "longdash")
COLOURS = 6  # that the page's style sheet has


def write_report(
    flights: Flights,
    folder: Path,
    command: str,
    unread: tuple[str, ...] = (),
    margins: Sequence[KnownMargins] = (),
) -> dict[str, Any]:
    """Write `report.html`, `metrics.json` and `figures/` for flights by label.

    Args:
        flights: at least one.
        folder: exists and is writable.
        command: as typed, for the foot of the report.
        unread: what is wrong with recordings that could not be read.
        margins: of `ftc-jsb margins`, for the flights that they are of.

    Returns:
        The contents of `metrics.json`.

    Raises:
        RecordingError: the folder cannot be written.
    """
    findings = find(flights, margins)
    series = flight_series(flights, findings)
    findings.document["samples_per_point"] = {label: s.every for label, s in series.items()}
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("ftc_jsb.report", "templates"),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    try:
        write_metrics(folder / "metrics.json", findings.document)
        drawn = draw_all(flights, folder / "figures")
        contents = _contents(flights, findings, series, unread)
        page = environment.get_template("report.html").render(
            **contents, command=command, figures=drawn, formats=FORMATS, script=_script()
        )
        (folder / "report.html").write_text(page, encoding="utf-8")
    except OSError as error:
        raise RecordingError(f"{folder}: the report cannot be written: {error}") from None
    return findings.document


def _contents(
    flights: Flights, findings: Findings, series: dict[str, Series], unread: tuple[str, ...]
) -> dict[str, Any]:
    document = findings.document
    titles = tables.flight_titles(flights)
    groups = by_scenario(flights)
    first = next(iter(flights.values()))
    drawn = charts(series)
    return {
        "title": _title(flights),
        "description": first.scenario.description.strip() if len(groups) == 1 else "",
        "notices": [*unread, *_ended_early(flights, titles), *findings.problems],
        "screens": first_screen(flights, document),
        "accepted": ACCEPTED,
        "table": result_table(flights, document),
        "group_names": list(groups),
        "scenario_differences": scenario_differences(flights),
        "difference_tables": tables.difference_tables(flights, document, titles),
        "model_table": tables.model_table(flights, document, titles),
        "estimator_table": tables.estimator_table(flights, document, titles),
        "stability_table": tables.stability_table(flights, document, titles),
        "samples_per_point": _samples_per_point(document, titles),
        "charts": drawn,
        "flight_chips": _chips(flights, titles),
        "data": _data(flights, titles, series, drawn),
        "scenarios": [
            (name, scenario_toml(plain(next(iter(members.values())).scenario)))
            for name, members in groups.items()
        ],
        "made": _made(flights),
    }


def _samples_per_point(document: dict[str, Any], titles: dict[str, str]) -> list[tuple[Quote, str]]:
    """How much the charts are thinned, and which flights by so much."""
    by_every: dict[int, list[str]] = {}
    for label, every in document["samples_per_point"].items():
        by_every.setdefault(every, []).append(label)
    return [
        (quote(document, ("samples_per_point", labels[0]), 0), "; ".join(titles[k] for k in labels))
        for labels in by_every.values()
    ]


def _chips(flights: Flights, titles: dict[str, str]) -> list[dict[str, Any]]:
    """Colour and dash of each flight: a colour for a model of a scenario, a dash for a loop."""
    colours: dict[tuple[str, str], int] = {}
    dashes: dict[str, int] = {}
    chips = []
    for name, members in by_scenario(flights).items():
        for label, flight in members.items():
            model = (name, words.model_title(flight.scenario))
            colour = colours.setdefault(model, len(colours)) % COLOURS
            loop = words.loop_title(flight.scenario)
            dash = DASHES[dashes.setdefault(loop, len(dashes)) % len(DASHES)]
            chips.append({"label": label, "title": titles[label], "colour": colour, "dash": dash})
    order = list(flights)
    return sorted(chips, key=lambda chip: order.index(chip["label"]))


def _data(
    flights: Flights, titles: dict[str, str], series: dict[str, Series], drawn: list[Any]
) -> markupsafe.Markup:
    """Flights and charts as JSON inside the page; `</` must not end the script element."""
    groups = {
        label: number
        for number, members in enumerate(by_scenario(flights).values())
        for label in members
    }
    entries = [
        {**chip, "group": groups[chip["label"]], "faults": fault_times(flights[chip["label"]])}
        | {"columns": series[chip["label"]].columns}
        for chip in _chips(flights, titles)
    ]
    text = json.dumps({"flights": entries, "charts": [as_data(chart) for chart in drawn]})
    return markupsafe.Markup(text.replace("</", "<\\/"))


def _script() -> dict[str, markupsafe.Markup]:
    """The page's style, its script, and Plotly from its package: nothing is fetched."""
    from plotly.offline import get_plotlyjs

    here = resources.files("ftc_jsb.report") / "templates"
    return {
        "style": markupsafe.Markup((here / "report.css").read_text(encoding="utf-8")),
        "plotly": markupsafe.Markup(get_plotlyjs()),
        "page": markupsafe.Markup((here / "report.js").read_text(encoding="utf-8")),
    }


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
