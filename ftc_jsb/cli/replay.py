"""`ftc-jsb replay`: a recording flown again, and compared bit for bit."""

import sys
from pathlib import Path
from typing import Any

import click

from ftc_jsb.cli.exit_codes import LIMIT_BROKEN
from ftc_jsb.cli.live import beside_flight
from ftc_jsb.cli.options import live_options


@click.command()
@click.argument("recording", metavar="FLIGHT.nc", type=click.Path(path_type=Path))
@live_options
def replay(recording: Path, **live: Any) -> None:
    """Fly a recording again, its commands included; exit code 1 if not bit for bit the same.

    A ground station may watch; what it says is ignored.
    """
    from ftc_jsb.recording.netcdf import attributes_of, load
    from ftc_jsb.simulation.replay import changed_since, differences
    from ftc_jsb.simulation.replay import replay as fly_again

    flight = load(recording)
    with beside_flight(
        flight.scenario, **{**live, "readonly": live["endpoint"] is not None}
    ) as beside:
        again = fly_again(flight, beside.observers if beside else ())
        if beside is not None:
            beside.flies_again(again)
    found = differences(flight, again)
    if not found:
        click.echo(
            f"{recording}: the same to the bit: {flight.record.size} samples, "
            f"{len(flight.commands)} commands"
        )
        return
    for change in changed_since(flight, attributes_of(recording)):
        click.echo(f"ftc-jsb: {change}", err=True)
    first = found[0]
    click.echo(
        f"ftc-jsb: {recording}: {len(found)} variables differ, the first is {first.name} from "
        f"{first.time:.2f} s on, by {first.largest:.3g} at most",
        err=True,
    )
    sys.exit(LIMIT_BROKEN)
