"""The result table of the page: a column for each flight, and the ratio without and with FTC."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from markupsafe import Markup

from ftc_jsb.analysis.verdict import passed
from ftc_jsb.recording.flight import Flight
from ftc_jsb.report.display_names import loop_title, model_title
from ftc_jsb.report.flight_groups import by_scenario
from ftc_jsb.report.metric_formats import Number, present, shown
from ftc_jsb.report.quoted_numbers import Quote, quote
from ftc_jsb.report.summary import verdict

Flights = Mapping[str, Flight]
Document = dict[str, Any]


class Column(NamedTuple):
    """A flight, or the ratio of two."""

    label: str  # of the flight; "" for a ratio
    ratio: int  # place in `with_and_without`; -1 for a flight
    title: str


class Head(NamedTuple):
    """A heading over several columns."""

    title: str
    span: int


class Cell(NamedTuple):
    """A number, and whether it is the best or the worst of its row."""

    number: Quote | str
    mark: str  # "", "best", "worst", "ratio"


class Row(NamedTuple):
    """A number of every flight."""

    group: str
    title: str
    unit: str
    cells: list[Cell]


class Table(NamedTuple):
    """The whole table."""

    scenarios: list[Head]  # empty where there is only one
    models: list[Head]
    columns: list[Column]
    verdicts: list[tuple[Markup, str]]  # words and class, one a column
    rows: list[Row]


def result_table(flights: Flights, document: Document) -> Table:
    """Flights by scenario and model, in the order flown."""
    scenarios: list[Head] = []
    models: list[Head] = []
    columns: list[Column] = []
    for name, members in by_scenario(flights).items():
        before = len(columns)
        by_model: dict[str, list[str]] = {}
        for label, flight in members.items():
            by_model.setdefault(model_title(flight.scenario), []).append(label)
        for title, labels in by_model.items():
            added = [Column(label, -1, loop_title(flights[label].scenario)) for label in labels]
            added += [
                Column("", index, "ratio")
                for index, pair in enumerate(document["with_and_without"])
                if pair["with_ftc"] in labels
            ]
            models.append(Head(title, len(added)))
            columns += added
        scenarios.append(Head(name, len(columns) - before))
    metrics = document["flights"]
    rows = []
    for number in present(metrics):
        marks = _marks(number, flights, metrics)
        cells = [_cell(number, column, marks, document) for column in columns]
        rows.append(Row(number.group, number.title, number.unit, cells))
    verdicts = [
        (verdict(document, c.label), "good" if passed(metrics[c.label]) else "bad")
        if c.label
        else (Markup(""), "")
        for c in columns
    ]
    return Table(scenarios if len(scenarios) > 1 else [], models, columns, verdicts, rows)


def _cell(number: Number, column: Column, marks: dict[str, str], document: Document) -> Cell:
    if column.label:
        path = ("flights", column.label, number.key)
        found = quote(document, path, number.digits, number.scale)
        return Cell(found, marks.get(column.label, ""))
    path_of_ratio = ("with_and_without", column.ratio, "ratio", number.key)
    ratio = quote(document, path_of_ratio, 2)
    return Cell("" if ratio.value is None else ratio, "ratio")


def _marks(number: Number, flights: Flights, metrics: dict[str, Any]) -> dict[str, str]:
    """Best and worst of each scenario, among completed flights, where they differ as shown."""
    marks: dict[str, str] = {}
    if not number.judged:
        return marks
    for members in by_scenario(flights).values():
        values = {
            label: metrics[label][number.key]
            for label in members
            if metrics[label].get(number.key) is not None and metrics[label]["status"] == "complete"
        }
        texts = {label: shown(number, metrics[label]) for label in values}
        if len(set(texts.values())) < 2:
            continue
        least, most = (texts[pick(values, key=values.__getitem__)] for pick in (min, max))
        marks |= {label: "best" for label, text in texts.items() if text == least}
        marks |= {label: "worst" for label, text in texts.items() if text == most}
    return marks
