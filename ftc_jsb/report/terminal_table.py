"""The result table on the terminal."""

from typing import Any

from ftc_jsb.analysis.metrics import Metrics
from ftc_jsb.analysis.verdict import passed
from ftc_jsb.report.display_names import verdict
from ftc_jsb.report.metric_formats import NUMBERS, present, shown

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


def print_table(metrics: dict[str, Metrics]) -> None:
    """Print one flight as a column of numbers, several as a row each."""
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    verdicts = [
        Text(verdict(values), style="green" if passed(values) else "red")
        for values in metrics.values()
    ]
    if len(metrics) == 1:
        (label,) = metrics
        table = Table("", label)
        table.columns[1].justify = "right"
        for number in present(metrics):
            if number.group:
                table.add_section()
            unit = f" [{number.unit}]" if number.unit else ""
            table.add_row(Text(number.title + unit), shown(number, metrics[label]))
        table.add_section()
        table.add_row("Verdict", *verdicts)
    else:
        title = "RMSE of V, path and heading; largest error of the effectiveness k"
        table = Table(title=title, box=SIMPLE_HEAD, padding=(0, 1, 0, 0))
        table.add_column("flight", overflow="fold")
        for heading in HEADINGS:
            table.add_column(Text(heading), justify="right", no_wrap=True)
        table.add_column("verdict", min_width=13)  # the one that may wrap, beside a long name
        chosen = {number.key: number for number in NUMBERS}
        for (label, values), word in zip(metrics.items(), verdicts, strict=True):
            table.add_row(label, *(shown(chosen[key], values) for key in COLUMNS), word)
    Console().print(table)
