"""`ftc-jsb report`: the report of recordings that exist."""

import sys
from pathlib import Path

import click

from ftc_jsb.cli.exit_codes import BAD_USAGE
from ftc_jsb.cli.options import (
    Output,
    examples,
    json_option,
    margins_option,
    output_options,
    recordings_argument,
)
from ftc_jsb.cli.printing import message
from ftc_jsb.cli.written_report import write_and_print


@examples(
    "ftc-jsb report a/flight.nc b/flight.nc --out both",
)
@click.command()
@recordings_argument
@output_options
@json_option
@margins_option
def report(
    recordings: tuple[Path, ...],
    output: Output,
    as_json: bool,
    margin_files: tuple[Path, ...],
) -> None:
    """Write the report of recordings that exist."""
    from ftc_jsb.report.measured_margins import read_margins
    from ftc_jsb.runs.recordings import labelled_recordings

    margins = [read_margins(path) for path in margin_files]
    flights, broken, files = labelled_recordings(recordings)
    for text in broken:
        message(text)
    with output.folder("report") as folder:
        write_and_print(flights, folder, as_json, files, tuple(broken), margins)
    if broken:
        sys.exit(BAD_USAGE)
