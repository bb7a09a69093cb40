"""The result table of the page: a column for each flight, and the ratio without and with FTC."""

from typing import Any, NamedTuple

from markupsafe import Markup

from ftc_jsb.analysis.verdict import passed
from ftc_jsb.report.flight_groups import Flights, by_scenario
from ftc_jsb.report.page.first_screen import linked_verdict
from ftc_jsb.report.page.linked_numbers import LinkedNumber, linked_number
from ftc_jsb.report.shown_metrics import ShownMetric, metric_text, metrics_at_hand
from ftc_jsb.report.titles import loop_title, model_title

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

    number: LinkedNumber | str
    standing: str  # "", "best", "worst", "ratio"


class Row(NamedTuple):
    """A number of every flight."""

    group: str
    title: str
    unit: str
    cells: list[Cell]


class ComparisonTable(NamedTuple):
    """The whole table."""

    scenarios: list[Head]  # empty where there is only one
    models: list[Head]
    columns: list[Column]
    verdicts: list[tuple[Markup, str]]  # words and class, one a column
    rows: list[Row]


def comparison_table(flights: Flights, document: Document) -> ComparisonTable:
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
    for metric in metrics_at_hand(metrics):
        standing = _best_and_worst(metric, flights, metrics)
        cells = [_cell(metric, column, standing, document) for column in columns]
        rows.append(Row(metric.group, metric.title, metric.unit, cells))
    verdicts = [
        (linked_verdict(document, c.label), "good" if passed(metrics[c.label]) else "bad")
        if c.label
        else (Markup(""), "")
        for c in columns
    ]
    return ComparisonTable(scenarios if len(scenarios) > 1 else [], models, columns, verdicts, rows)


def _cell(
    metric: ShownMetric, column: Column, standing: dict[str, str], document: Document
) -> Cell:
    if column.label:
        path = ("flights", column.label, metric.key)
        found = linked_number(document, path, metric.digits, metric.scale)
        return Cell(found, standing.get(column.label, ""))
    path_of_ratio = ("with_and_without", column.ratio, "ratio", metric.key)
    ratio = linked_number(document, path_of_ratio, 2)
    return Cell("" if ratio.value is None else ratio, "ratio")


def _best_and_worst(
    metric: ShownMetric, flights: Flights, metrics: dict[str, Any]
) -> dict[str, str]:
    """Best and worst of each scenario and model, among completed flights, where they differ as shown."""
    standing: dict[str, str] = {}
    if not metric.judged:
        return standing
    for members in _by_scenario_and_model(flights):
        values = {
            label: metrics[label][metric.key]
            for label in members
            if metrics[label].get(metric.key) is not None and metrics[label]["status"] == "complete"
        }
        texts = {label: metric_text(metric, metrics[label]) for label in values}
        if len(set(texts.values())) < 2:
            continue
        least, most = (texts[pick(values, key=values.__getitem__)] for pick in (min, max))
        standing |= {label: "best" for label, text in texts.items() if text == least}
        standing |= {label: "worst" for label, text in texts.items() if text == most}
    return standing


def _by_scenario_and_model(flights: Flights) -> list[list[str]]:
    """Labels of flights that may be ranked: models are different aircraft, and never ranked."""
    groups: dict[tuple[str, str], list[str]] = {}
    for name, members in by_scenario(flights).items():
        for label, flight in members.items():
            groups.setdefault((name, flight.scenario.model), []).append(label)
    return list(groups.values())
