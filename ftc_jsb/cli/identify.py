"""`ftc-jsb identify`: a point mass fitted to virtual flight tests of an aircraft."""

import sys

import click

from ftc_jsb.cli.exit_codes import DONE, LIMIT_BROKEN
from ftc_jsb.cli.options import Output, aircraft_argument, examples, output_options
from ftc_jsb.cli.printing import message
from ftc_jsb.cli.task_bar import step_bar


@examples(
    "ftc-jsb identify f16 --out my-f16",
)
@click.command()
@aircraft_argument
@output_options
def identify(aircraft: str, output: Output) -> None:
    """Fit the point mass of AIRCRAFT to virtual flight tests; write point_mass.toml.

    AIRCRAFT is a shipped one or a folder with aircraft.toml and inner_loop.xml, as `ftc-jsb inner-loop`
    writes it. Exit code 1 where a residual is too large to fly on.
    """
    from ftc_jsb.aircraft.description import load_aircraft
    from ftc_jsb.identify.identification import identify as run
    from ftc_jsb.identify.identification import steps
    from ftc_jsb.identify.judgement import shortcomings
    from ftc_jsb.identify.point_mass_contents import write_point_mass

    loaded = load_aircraft(aircraft)
    with output.folder(f"identify-{loaded.name}") as folder:
        with step_bar("Flight tests", steps(loaded)) as tell:
            contents = run(loaded, tell)
        write_point_mass(folder / "point_mass.toml", contents)
    for key, value in contents["identification"].items():
        click.echo(f"{key}: {value}")
    click.echo(f"Written: {folder / 'point_mass.toml'}")
    short = shortcomings(contents["identification"])
    for what in short:
        message(f"not good enough: {what}")
    sys.exit(LIMIT_BROKEN if short else DONE)
