"""Reports and tables that verbs write and print."""

import json
import shlex
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click


def margins_of(files: Sequence[Path]) -> list[Any]:
    """Margins that `ftc-jsb margins` wrote."""
    from ftc_jsb.report.measured_margins import read_margins

    return [read_margins(path) for path in files]


def write_results(
    flights: dict[str, Any],
    folder: Path,
    as_json: bool,
    unread: tuple[str, ...] = (),
    margins: Sequence[Any] = (),
) -> None:
    """Write the report of flights; print its table, or its numbers as JSON."""
    from ftc_jsb.report.page.write import write_report
    from ftc_jsb.report.terminal.flights import print_effects, print_flights

    command = shlex.join(["ftc-jsb", *sys.argv[1:]])
    document = write_report(flights, folder, command, unread, margins)
    if as_json:
        click.echo(json.dumps(document, indent=2))
    else:
        print_flights(document["flights"])
        print_effects(document["ftc_helped"])
        click.echo(f"Report: {folder / 'report.html'}")
