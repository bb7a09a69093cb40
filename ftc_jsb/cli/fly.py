"""`ftc-jsb fly`: one flight."""

import json
import sys
from typing import TYPE_CHECKING, Any, NoReturn

import click

from ftc_jsb.cli.announcement import announce
from ftc_jsb.cli.completed_names import loops
from ftc_jsb.cli.exit_codes import BAD_USAGE, DONE, INTERRUPTED, LIMIT_BROKEN
from ftc_jsb.cli.live import LiveOptions, flying_beside, live_options
from ftc_jsb.cli.options import (
    MODELS,
    Output,
    code_option,
    examples,
    json_option,
    output_options,
    scenario_argument,
    set_option,
)
from ftc_jsb.cli.printing import message, note, print_json

if TYPE_CHECKING:
    from ftc_jsb.runs.observers import ObserverFactory


@examples(
    "ftc-jsb fly paper --model jsbsim --loop no-ftc",
    "ftc-jsb fly severe --set 'fault[0].effectiveness=0.5' --out my-flight",
    "ftc-jsb fly paper --realtime --mavlink udpout:127.0.0.1:14550",
)
@click.command()
@scenario_argument
@click.option("--model", type=MODELS, help="What is flown.")
@click.option(
    "--loop",
    metavar="NAME",
    shell_complete=loops,
    help="Outer loop: a name, or package.module:Class.",
)
@click.option(
    "--flightgear", metavar="HOST:PORT", help="Show the flight in FlightGear, in real time."
)
@set_option
@code_option
@output_options
@json_option
@live_options
def fly(
    scenario: str,
    model: str | None,
    loop: str | None,
    flightgear: str | None,
    overrides: tuple[str, ...],
    allow_code: bool,
    output: Output,
    as_json: bool,
    live: LiveOptions,
) -> None:
    """Fly SCENARIO once; write flight.nc and metrics.json."""
    from ftc_jsb.cli.progress import progress_for
    from ftc_jsb.loops.code import refuse_code
    from ftc_jsb.runs.single import fly_and_save
    from ftc_jsb.scenario.load import load_scenario

    flown = load_scenario(scenario, [*overrides, *overrides_of(model, loop)])
    if not allow_code:
        refuse_code([flown.loop.name], scenario, [*overrides, loop or ""])
    observers_for: ObserverFactory = progress_for(flown, as_json)
    if flightgear is not None:
        from ftc_jsb.flightgear.viewer import shown_to, start_line, viewer

        note(f"FlightGear looks on by: {start_line(viewer(flightgear), flown.initial)}")
        observers_for = shown_to(flightgear, flown, observers_for)
        live = live._replace(realtime=live.realtime or 1.0)
    with output.folder(flown.name) as folder:
        announce(flown, overrides)
        with flying_beside(flown, live) as beside:
            result = fly_and_save(flown, folder, observers_for, beside)
    for line in beside.summary() if beside is not None else ():
        message(line)
    if as_json:
        print_json({**result.document, "recording": str(folder / "flight.nc")})
    else:
        from ftc_jsb.report.terminal.flights import print_flights

        print_flights({result.label: result.metrics})
        click.echo(f"Recording: {folder / 'flight.nc'}")
    exit_by(result.metrics)


def overrides_of(model: str | None, loop: str | None) -> list[str]:
    """The options --model and --loop as overrides of the scenario."""
    overrides = [f'model="{model}"'] if model else []
    return overrides + ([f"loop.name={json.dumps(loop)}"] if loop else [])


def exit_by(metrics: dict[str, Any]) -> NoReturn:
    """Say what went wrong in a flight, and end by its exit code."""
    from ftc_jsb.analysis.verdict import passed

    for limit in metrics["limits_broken"]:
        message(
            f"limit broken: {limit['name']} first at {limit['time']:.2f} s, "
            f"worst {limit['value']:.4g} against {limit['limit']:g}"
        )
    if metrics["status"] == "interrupted":
        message(f"interrupted at {metrics['end_time_s']:.2f} s; saved")
        sys.exit(INTERRUPTED)
    if metrics["status"] == "failed":
        message(f"{metrics['reason']}; what was flown is saved")
        sys.exit(BAD_USAGE)
    if metrics["loss_of_control"] is not None:
        message(
            f"control lost at {metrics['loss_of_control_time_s']:.2f} s: {metrics['loss_of_control']}"
        )
    if metrics["status"] == "departed":
        message(f"departed at {metrics['end_time_s']:.2f} s: {metrics['reason']}")
    sys.exit(DONE if passed(metrics) else LIMIT_BROKEN)
