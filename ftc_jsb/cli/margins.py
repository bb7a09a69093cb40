"""`ftc-jsb margins`: stability margins measured in level flight."""

from pathlib import Path
from typing import TYPE_CHECKING, cast

import click

from ftc_jsb.cli.announcement import announce
from ftc_jsb.cli.options import (
    MODELS,
    FiniteRange,
    Output,
    code_option,
    examples,
    json_option,
    output_options,
)
from ftc_jsb.cli.printing import print_json
from ftc_jsb.cli.task_bar import step_bar

if TYPE_CHECKING:
    from ftc_jsb.scenario.schema import Model


@examples(
    "ftc-jsb margins f16",
    "ftc-jsb margins paper --model paper --airspeed 250",
)
@click.command()
@click.argument("name", metavar="SCENARIO|AIRCRAFT")
@click.option("--model", type=MODELS, default="jsbsim", show_default=True, help="What is flown.")
@click.option(
    "--airspeed", metavar="M/S", type=FiniteRange(0.0, 1e5), help="In place of the scenario's."
)
@click.option(
    "--altitude", metavar="M", type=FiniteRange(0.0, 1e5), help="In place of the scenario's."
)
@click.option(
    "--amplitude",
    metavar="FACTOR",
    type=FiniteRange(1e-3, 1e3),
    default=1.0,
    show_default=True,
    help="Of the signals that are injected: 20 N, 0.005 g, 0.005 rad times this.",
)
@code_option
@output_options
@json_option
def margins(
    name: str,
    model: str,
    airspeed: float | None,
    altitude: float | None,
    amplitude: float,
    allow_code: bool,
    output: Output,
    as_json: bool,
) -> None:
    """Measure gain, phase and delay margins in level flight; write margins.json and bode.png."""
    from ftc_jsb.atomic_file import atomic_file
    from ftc_jsb.loops.code import refuse_code
    from ftc_jsb.margins.condition import level_scenario
    from ftc_jsb.margins.document import document
    from ftc_jsb.margins.measure import CHANNELS, STEPS, channel_margins
    from ftc_jsb.runs.metrics_file import write_metrics

    flown = level_scenario(name, cast("Model", model), airspeed, altitude)
    if not allow_code:
        refuse_code([flown.loop.name], name, ())
    with output.folder(f"margins-{Path(name).stem}") as folder:
        announce(flown)
        found = []
        with step_bar("Margins", STEPS * len(CHANNELS)) as tell:
            for channel in CHANNELS:  # written as it goes: an interruption loses nothing finished
                found.append(channel_margins(flown, channel, tell, amplitude))
                write_metrics(folder / "margins.json", document(flown, found))
        from ftc_jsb.report.figures.bode import bode_figure
        from ftc_jsb.report.terminal.margins import print_margins

        what = flown.aircraft.name if model != "paper" else "paper"
        at = f"{flown.initial.airspeed:g} m/s, {flown.initial.altitude:g} m"
        title = f"{what} ({model}), loop {flown.loop.name}, {at}"
        with atomic_file(folder / "bode.png") as part:
            bode_figure(title, found).savefig(part, format="png", dpi=150)
    if as_json:
        print_json({**document(flown, found), "written": str(folder / "margins.json")})
    else:
        print_margins(title, found)
        click.echo(f"Written: {folder / 'margins.json'}, {folder / 'bode.png'}")
