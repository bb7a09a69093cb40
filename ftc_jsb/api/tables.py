"""Metrics of flights as HTML tables for notebooks and as rows for pandas."""

from collections.abc import Mapping
from html import escape
from typing import Any

Metrics = dict[str, Any]


def metrics_html(metrics: Mapping[str, Metrics]) -> str:
    """Flights beside each other: their verdicts and the metrics that any of them has."""
    from ftc_jsb.report.shown_metrics import metric_text, metrics_at_hand
    from ftc_jsb.report.verdicts import verdict_text
    from ftc_jsb.vocabulary.quantities import with_unit

    flights = dict(metrics)
    head = "".join(f"<th>{escape(label)}</th>" for label in flights)
    rows = [("Verdict", [verdict_text(m) for m in flights.values()])]
    for metric in metrics_at_hand(flights):
        title = with_unit(metric.title, metric.unit)
        rows.append((title, [metric_text(metric, m) for m in flights.values()]))
    body = "".join(
        f"<tr><th style='text-align:left'>{escape(title)}</th>"
        + "".join(f"<td>{escape(cell)}</td>" for cell in cells)
        + "</tr>"
        for title, cells in rows
    )
    return f"<table><thead><tr><th></th>{head}</tr></thead><tbody>{body}</tbody></table>"


def flat(metrics: Metrics) -> Metrics:
    """Numbers, truths and texts of the metrics of a flight, in one level: what a table can hold."""
    row: Metrics = {}
    for key, value in metrics.items():
        if isinstance(value, dict):
            row |= {f"{key}.{name}": part for name, part in value.items() if _plain(part)}
        elif _plain(value):
            row[key] = value
    return row


def _plain(value: Any) -> bool:
    return value is None or isinstance(value, bool | int | float | str)
