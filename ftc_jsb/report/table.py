"""The result table on the terminal."""

from ftc_jsb.metrics import Metrics, passed
from ftc_jsb.report.words import FIGURES, shown, verdict

COLUMNS = (
    "rmse_airspeed_mps",
    "rmse_flight_path_deg",
    "rmse_heading_deg",
    "effectiveness_thrust_error_max",
    "detection_delay_s",
    "saturated_fraction",
)  # what fits beside each other on 80 columns; the report has the rest
HEADINGS = ("V [m/s]", "path [deg]", "heading [deg]", "k error", "found [s]", "limit [%]")


def print_table(metrics: dict[str, Metrics]) -> None:
    """Print one flight as a column of numbers, several as a row each."""
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
        for figure in FIGURES:
            unit = f" [{figure.unit}]" if figure.unit else ""
            table.add_row(Text(figure.title + unit), shown(figure, metrics[label]))
        table.add_section()
        table.add_row("Verdict", *verdicts)
    else:
        table = Table(title="RMSE of V, path and heading; largest error of the effectiveness k")
        table.add_column("flight", no_wrap=True)
        for heading in HEADINGS:
            table.add_column(Text(heading), justify="right")
        table.add_column("verdict")
        chosen = {figure.key: figure for figure in FIGURES}
        for (label, values), word in zip(metrics.items(), verdicts, strict=True):
            table.add_row(label, *(shown(chosen[key], values) for key in COLUMNS), word)
    Console().print(table)
