"""The result table on the terminal."""

from ftc_jsb.metrics import Metrics, passed
from ftc_jsb.report.words import FIGURES, shown, verdict


def print_table(metrics: dict[str, Metrics]) -> None:
    """Print a row for each number, a column for each flight."""
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table()
    table.add_column("")
    for label in metrics:
        table.add_column(label, justify="right")
    for figure in FIGURES:
        unit = f" [{figure.unit}]" if figure.unit else ""
        cells = [shown(figure, values) for values in metrics.values()]
        table.add_row(Text(figure.title + unit), *cells)
    verdicts = [
        Text(verdict(values), style="green" if passed(values) else "red")
        for values in metrics.values()
    ]
    table.add_section()
    table.add_row("Verdict", *verdicts)
    console = Console()
    console.print(table) if console.width >= 100 or len(metrics) < 3 else _print_lines(metrics)


def _print_lines(metrics: dict[str, Metrics]) -> None:
    """The same for a narrow terminal: a block for each flight."""
    for label, values in metrics.items():
        print(f"{label}: {verdict(values)}")
        for figure in FIGURES:
            unit = f" {figure.unit}" if figure.unit else ""
            print(f"  {figure.title:<26}{shown(figure, values)}{unit}")
