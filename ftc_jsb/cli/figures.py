"""`ftc-jsb figures`: the paper's figures for print."""

import re
import sys
from pathlib import Path
from typing import NamedTuple

import click

from ftc_jsb.cli.exit_codes import BAD_USAGE
from ftc_jsb.cli.options import Output, examples, grouped, output_options, recordings_argument
from ftc_jsb.cli.printing import message

FORMATS = ("pdf", "svg", "png")
INCHES = {"in": 1.0, "cm": 1.0 / 2.54, "mm": 1.0 / 25.4, "pt": 1.0 / 72.0}
WIDEST = 40.0  # [in]
NARROWEST = 1.5  # [in]


class Length(click.ParamType):  # type: ignore[type-arg]  # generic from click 8.4 on
    """A length: `3.5` in inches, `88mm`, `8.8cm`, `252pt`."""

    name = "length"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """Inches."""
        found = re.fullmatch(r"([0-9]*\.?[0-9]+) *(in|cm|mm|pt)?", str(value).strip())
        length = float(found[1]) * INCHES[found[2] or "in"] if found else 0.0
        if not NARROWEST <= length <= WIDEST:
            self.fail(
                f"{value!r} is no width of a figure; "
                f"expected {NARROWEST:g} to {WIDEST:g} in, such as 3.5, 88mm or 8.8cm.",
                param,
                ctx,
            )
        return length


class Publisher(NamedTuple):
    """What is asked of the figures."""

    font: str | None
    width: float | None
    formats: tuple[str, ...]


publisher_options = grouped(
    "publisher",
    Publisher,
    click.option("--font", metavar="NAME", help="Font family, such as 'Times New Roman' or serif."),
    click.option(
        "--width", type=Length(), metavar="WIDTH",
        help="Width of every figure: inches, or 88mm, 8.8cm, 252pt.",
    ),
    click.option(
        "--format", "formats", multiple=True, type=click.Choice(FORMATS),
        help="Format, may be given several times; all of them by default.",
    ),
)  # fmt: skip


@examples(
    "ftc-jsb figures out/paper/flight.nc --out figures",
    "ftc-jsb figures out/paper/*.nc --font serif --width 88mm --format pdf --out figures",
)
@click.command()
@recordings_argument
@publisher_options
@output_options
def figures(recordings: tuple[Path, ...], publisher: Publisher, output: Output) -> None:
    """Draw the paper's figures of recordings for print: PDF, SVG and PNG, as wide as a column."""
    from ftc_jsb.report.figures.draw import draw_all
    from ftc_jsb.report.figures.style import Print
    from ftc_jsb.runs.recordings import labelled_recordings

    formats = tuple(dict.fromkeys(publisher.formats)) or FORMATS
    asked = Print(publisher.font, publisher.width, formats).checked()
    flights, broken, _ = labelled_recordings(recordings)
    for text in broken:
        message(text)
    with output.folder("figures") as folder:
        for name in draw_all(flights, folder, asked):
            click.echo(f"Drawn: {folder / name}{', '.join(f'.{suffix}' for suffix in formats)}")
    if broken:
        sys.exit(BAD_USAGE)
