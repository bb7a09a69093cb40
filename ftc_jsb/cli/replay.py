"""`ftc-jsb replay`: a recording flown again and compared to the bit."""

import sys
from pathlib import Path

import click

from ftc_jsb.cli.exit_codes import LIMIT_BROKEN
from ftc_jsb.cli.live import LiveOptions, flying_beside, live_options
from ftc_jsb.cli.options import code_option, examples, recording_argument
from ftc_jsb.cli.printing import message, note


@examples(
    "ftc-jsb replay out/a-live-flight/flight.nc",
    "ftc-jsb replay flight.nc --flightgear 127.0.0.1:5550",
)
@click.command()
@recording_argument
@click.option(
    "--flightgear", metavar="HOST:PORT", help="Show the recording in FlightGear, in real time."
)
@code_option
@live_options
def replay(recording: Path, flightgear: str | None, allow_code: bool, live: LiveOptions) -> None:
    """Fly a recording again, its commands included; exit code 1 if not bit for bit the same.

    A ground station may watch; what it says is ignored. With --flightgear it is shown, not flown.
    """
    from ftc_jsb.loops.code import refuse_code
    from ftc_jsb.recording.netcdf import load
    from ftc_jsb.simulation.replay import changed_since, differences
    from ftc_jsb.simulation.replay import replay as fly_again

    flight = load(recording)
    if flightgear is not None:
        from ftc_jsb.flightgear.viewer import show, start_line, viewer

        note(f"FlightGear looks on by: {start_line(viewer(flightgear), flight.scenario.initial)}")
        show(flightgear, flight, live.realtime or 1.0)
        click.echo(f"{recording}: shown")
        return
    if not allow_code:
        refuse_code([flight.scenario.loop.name], str(recording), ())
    watched = live._replace(readonly=live.endpoint is not None)
    with flying_beside(flight.scenario, watched) as beside:
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
    for change in changed_since(flight):
        message(change)
    first = found[0]
    message(
        f"{recording}: {len(found)} variables differ, the first is {first.name} from "
        f"{first.time:.2f} s on, by {first.largest:.3g} at most"
    )
    sys.exit(LIMIT_BROKEN)
