"""`ftc-jsb figures`: the paper's figures for print."""

import sys
from pathlib import Path

import click

from ftc_jsb.cli.exit_codes import BAD_USAGE
from ftc_jsb.cli.options import Output, examples, output_options, recordings_argument
from ftc_jsb.cli.printing import message


@examples(
    "ftc-jsb figures out/paper/flight.nc --out figures",
)
@click.command()
@recordings_argument
@output_options
def figures(recordings: tuple[Path, ...], output: Output) -> None:
    """Draw the paper's figures of recordings for print: PDF, SVG and PNG, as wide as a column."""
    from ftc_jsb.report.figures.draw import draw_all
    from ftc_jsb.runs.recordings import labelled_recordings

    flights, broken = labelled_recordings(recordings)
    for text in broken:
        message(text)
    with output.folder("figures") as folder:
        for name in draw_all(flights, folder):
            click.echo(f"Drawn: {folder / name}.pdf, .svg, .png")
    if broken:
        sys.exit(BAD_USAGE)
