"""The result table of flights on the terminal."""

from typing import TYPE_CHECKING, Any

from ftc_jsb.analysis.metrics import Metrics
from ftc_jsb.analysis.verdict import passed
from ftc_jsb.report.shown_metrics import SHOWN_METRICS, metric_text, metrics_at_hand
from ftc_jsb.report.verdicts import verdict_text
from ftc_jsb.vocabulary.quantities import with_unit

if TYPE_CHECKING:
    from rich.table import Table
    from rich.text import Text

COLUMNS = (
    "rmse_airspeed_mps",
    "rmse_flight_path_deg",
    "rmse_heading_deg",
    "effectiveness_thrust_error_max",
    "detection_delay_s",
)  # what fits beside each other on 80 columns; the report has the rest
HEADINGS = ("V\n[m/s]", "path\n[deg]", "heading\n[deg]", "k error", "found\n[s]")


def print_effects(effects: list[dict[str, Any]]) -> None:
    """Print whether FTC helped, a line for each pair of flights."""
    for pair in effects:
        one, two = pair["rmse_airspeed_with_mps"], pair["rmse_airspeed_without_mps"]
        numbers = "" if one is None or two is None else f", airspeed RMSE {one:.3g} / {two:.3g} m/s"
        flights = f"{pair['with_ftc']} / {pair['without_ftc']}"
        print(f"Did FTC help? {pair['scenario']}, {flights}: {pair['answer']}{numbers}")


def print_flights(metrics: dict[str, Metrics]) -> None:
    """Print one flight as a column of numbers, several as a row each."""
    from rich.console import Console

    Console().print(_single(metrics) if len(metrics) == 1 else _several(metrics))


def _single(metrics: dict[str, Metrics]) -> "Table":
    from rich.table import Table
    from rich.text import Text

    ((label, values),) = metrics.items()
    table = Table("", label)
    table.columns[1].justify = "right"
    for metric in metrics_at_hand(metrics):
        if metric.group:
            table.add_section()
        table.add_row(Text(with_unit(metric.title, metric.unit)), metric_text(metric, values))
    table.add_section()
    table.add_row("Verdict", _verdict(values))
    return table


def _several(metrics: dict[str, Metrics]) -> "Table":
    from rich.box import SIMPLE_HEAD
    from rich.table import Table
    from rich.text import Text

    title = "RMSE of V, path and heading; largest error of the effectiveness k"
    table = Table(title=title, box=SIMPLE_HEAD, padding=(0, 1, 0, 0))
    table.add_column("flight", overflow="fold")
    for heading in HEADINGS:
        table.add_column(Text(heading), justify="right", no_wrap=True)
    table.add_column("verdict", min_width=13)  # the one that may wrap, beside a long name
    chosen = {metric.key: metric for metric in SHOWN_METRICS}
    for label, values in metrics.items():
        cells = (metric_text(chosen[key], values) for key in COLUMNS)
        table.add_row(label, *cells, _verdict(values))
    return table


def _verdict(values: Metrics) -> "Text":
    from rich.text import Text

    return Text(verdict_text(values), style="green" if passed(values) else "red")
