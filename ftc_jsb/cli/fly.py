"""`ftc-jsb fly`: one scenario, one model, one loop."""

import json
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Any

import click

from ftc_jsb.cli.exit_codes import exit_by
from ftc_jsb.cli.live import beside_flight, paced
from ftc_jsb.cli.options import (
    force_option,
    json_option,
    live_options,
    out_option,
    scenario_argument,
    set_option,
)
from ftc_jsb.cli.scenario import announce, load, progress_for, with_model_and_loop


@click.command()
@scenario_argument
@click.option(
    "--model", type=click.Choice(["paper", "identified", "jsbsim"]), help="What is flown."
)
@click.option("--loop", metavar="NAME", help="Outer loop: a name, or package.module:Class.")
@click.option(
    "--flightgear", metavar="HOST:PORT", help="Show the flight in FlightGear, in real time."
)
@set_option
@out_option
@force_option
@json_option
@live_options
def fly(
    scenario: str,
    model: str | None,
    loop: str | None,
    flightgear: str | None,
    overrides: tuple[str, ...],
    out: Path | None,
    force: bool,
    as_json: bool,
    **live: Any,
) -> None:
    """Fly SCENARIO once; write flight.nc and metrics.json."""
    from ftc_jsb.runs.output_folder import output_folder
    from ftc_jsb.runs.single import fly_and_save

    flown = load(scenario, with_model_and_loop(overrides, model, loop))
    watch = progress_for(flown, as_json)
    shown: AbstractContextManager[Path | None] = nullcontext()
    if flightgear is not None:
        from ftc_jsb.flightgear.viewer import output_directive, viewer

        shown = output_directive(viewer(flightgear, flown))
        if live["endpoint"] is None and live["realtime"] is None:
            watch = paced(watch, flown.loop.rate)
        else:
            live["realtime"] = live["realtime"] or 1.0
    with output_folder(out, flown.name, force) as folder:
        announce(flown)
        with shown as output, beside_flight(flown, **live) as beside:
            result = fly_and_save(flown, folder, watch, beside, output)
    if beside is not None:
        for line in beside.summary():
            click.echo(f"ftc-jsb: {line}", err=True)
    if as_json:
        click.echo(json.dumps(result.document, indent=2))
    else:
        from ftc_jsb.report.terminal.flights import print_flights

        print_flights({result.label: result.metrics})
        click.echo(f"Recording: {folder / 'flight.nc'}")
    exit_by(result.metrics)
