"""`ftc-jsb report`: the report of recordings that exist."""

import sys
from pathlib import Path

import click

from ftc_jsb.cli.exit_codes import BAD_USAGE
from ftc_jsb.cli.options import force_option, json_option, margins_option, out_option
from ftc_jsb.cli.results import margins_of, write_results


@click.command()
@click.argument(
    "recordings", metavar="FLIGHT.nc...", nargs=-1, required=True, type=click.Path(path_type=Path)
)
@out_option
@force_option
@json_option
@margins_option
def report(
    recordings: tuple[Path, ...],
    out: Path | None,
    force: bool,
    as_json: bool,
    margin_files: tuple[Path, ...],
) -> None:
    """Write the report of recordings that exist."""
    from ftc_jsb.runs.output_folder import output_folder
    from ftc_jsb.runs.recordings import labelled_recordings

    margins = margins_of(margin_files)
    flights, broken = labelled_recordings(recordings)
    for message in broken:
        click.echo(f"ftc-jsb: {message}", err=True)
    with output_folder(out, "report", force) as folder:
        write_results(flights, folder, as_json, tuple(broken), margins)
    if broken:
        sys.exit(BAD_USAGE)
