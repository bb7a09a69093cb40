"""`ftc-jsb export`: an aircraft with its inner loop, for plain JSBSim."""

from pathlib import Path

import click

from ftc_jsb.cli.options import aircraft_argument, examples, force_option


@examples(
    "ftc-jsb export f16 my-f16",
    "ftc-jsb export f16 my-f16 --flightgear",
)
@click.command()
@aircraft_argument
@click.argument("folder", metavar="DIR", type=click.Path(path_type=Path))
@click.option("--stock", is_flag=True, help="Without the corrections of its flight control.")
@click.option("--flightgear", is_flag=True, help="For FlightGear, with menu and dialog.")
@force_option
def export(aircraft: str, folder: Path, stock: bool, flightgear: bool, force: bool) -> None:
    """Write AIRCRAFT with its inner loop to DIR, for plain JSBSim, with a script that flies it."""
    from ftc_jsb.aircraft.description import load_aircraft
    from ftc_jsb.export.aircraft_folder import export as run
    from ftc_jsb.export.flightgear.aircraft_folder import export_flightgear
    from ftc_jsb.runs.output_folder import output_folder
    from ftc_jsb.scenario.schema import AircraftChoice

    loaded = load_aircraft(aircraft)
    with output_folder(folder, loaded.name, force, "DIR"):
        if flightgear:
            choice = AircraftChoice(flight_control="stock" if stock else "corrected")
            written = export_flightgear(loaded, choice, folder)
        else:
            written = run(loaded, not stock, folder)
    click.echo(f"{len(written)} files in {folder}; to fly it, and under whose licence: ")
    click.echo(f"{folder / 'README.txt'}, {folder / 'NOTICE'}")
