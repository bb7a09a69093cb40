"""`ftc-jsb identify`: a point mass fitted to virtual flight tests."""

from pathlib import Path

import click

from ftc_jsb.cli.options import force_option, out_option


@click.command()
@click.argument("aircraft", metavar="AIRCRAFT")
@out_option
@force_option
def identify(aircraft: str, out: Path | None, force: bool) -> None:
    """Fit the point mass of AIRCRAFT to virtual flight tests; write point_mass.toml."""
    from ftc_jsb.aircraft.description import load_aircraft
    from ftc_jsb.identify.identification import identify as run
    from ftc_jsb.identify.point_mass_contents import write_point_mass
    from ftc_jsb.runs.output_folder import output_folder

    loaded = load_aircraft(aircraft)
    with output_folder(out, f"identify-{loaded.name}", force) as folder:
        contents = run(loaded, lambda line: click.echo(line, err=True))
        write_point_mass(folder / "point_mass.toml", contents)
    for key, value in contents["identification"].items():
        click.echo(f"{key}: {value}")
    click.echo(f"Written: {folder / 'point_mass.toml'}")
