"""`ftc-jsb figures`: the paper's figures of recordings, for print."""

import sys
from pathlib import Path

import click

from ftc_jsb.cli.exit_codes import BAD_USAGE
from ftc_jsb.cli.options import force_option, out_option


@click.command()
@click.argument(
    "recordings", metavar="FLIGHT.nc...", nargs=-1, required=True, type=click.Path(path_type=Path)
)
@out_option
@force_option
def figures(recordings: tuple[Path, ...], out: Path | None, force: bool) -> None:
    """Draw the paper's figures of recordings for print: PDF, SVG and PNG, as wide as a column."""
    from ftc_jsb.report.figures.draw import draw_all
    from ftc_jsb.runs.output_folder import output_folder
    from ftc_jsb.runs.recordings import labelled_recordings

    flights, broken = labelled_recordings(recordings)
    for message in broken:
        click.echo(f"ftc-jsb: {message}", err=True)
    with output_folder(out, "figures", force) as folder:
        for name in draw_all(flights, folder):
            click.echo(f"Drawn: {folder / name}.pdf, .svg, .png")
    if broken:
        sys.exit(BAD_USAGE)
