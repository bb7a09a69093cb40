"""The report as `ftc-jsb compare` and `ftc-jsb report` write it, and what they print of it."""

import shlex
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ftc_jsb.cli.printing import print_json
from ftc_jsb.cli.task_bar import step_bar

if TYPE_CHECKING:
    from ftc_jsb.recording.flight import Flight
    from ftc_jsb.report.measured_margins import MeasuredMargins


def write_and_print(
    flights: "dict[str, Flight]",
    folder: Path,
    as_json: bool,
    recordings: Mapping[str, Path],
    unread: tuple[str, ...] = (),
    margins: "Sequence[MeasuredMargins]" = (),
) -> None:
    """Write the report of flights by label; print its table, or its numbers as JSON.

    Args:
        flights: at least one.
        folder: exists and is writable.
        as_json: print for machines.
        recordings: files of the flights, by label, which the page links to.
        unread: what is wrong with recordings that could not be read.
        margins: shown with the flights that they are of.

    Raises:
        RecordingError: the folder cannot be written.
    """
    from ftc_jsb.report.page.write import steps, write_report
    from ftc_jsb.report.terminal.flights import print_effects, print_flights

    command = shlex.join(["ftc-jsb", *sys.argv[1:]])
    with step_bar("Report", steps(flights), lines=False) as tell:
        document = write_report(flights, folder, command, unread, margins, tell, recordings)
    if as_json:
        print_json({**document, "report": str(folder / "report.html")})
    else:
        print_flights(document["flights"])
        print_effects(document["ftc_helped"])
        click.echo(f"Report: {folder / 'report.html'}")
