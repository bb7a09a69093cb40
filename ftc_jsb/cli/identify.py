"""`ftc-jsb identify`: a point mass fitted to virtual flight tests of an aircraft."""

import click

from ftc_jsb.cli.options import Output, aircraft_argument, output_options
from ftc_jsb.cli.printing import progress_line


@click.command()
@aircraft_argument
@output_options
def identify(aircraft: str, output: Output) -> None:
    """Fit the point mass of AIRCRAFT to virtual flight tests; write point_mass.toml."""
    from ftc_jsb.aircraft.description import load_aircraft
    from ftc_jsb.identify.identification import identify as run
    from ftc_jsb.identify.point_mass_contents import write_point_mass

    loaded = load_aircraft(aircraft)
    with output.folder(f"identify-{loaded.name}") as folder:
        contents = run(loaded, progress_line)
        write_point_mass(folder / "point_mass.toml", contents)
    for key, value in contents["identification"].items():
        click.echo(f"{key}: {value}")
    click.echo(f"Written: {folder / 'point_mass.toml'}")
