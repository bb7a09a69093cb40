"""`ftc-jsb compare`: every model and loop of a scenario, and their report."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ftc_jsb.cli.announcement import announce
from ftc_jsb.cli.exit_codes import INTERRUPTED
from ftc_jsb.cli.options import (
    Output,
    code_option,
    examples,
    json_option,
    margins_option,
    output_options,
    scenario_argument,
    set_option,
)
from ftc_jsb.cli.written_report import write_and_print
from ftc_jsb.errors import RecordingError

if TYPE_CHECKING:
    from ftc_jsb.recording.flight import Flight


@examples(
    "ftc-jsb compare paper",
    "ftc-jsb compare turbulence --set 'compare.models=[\"jsbsim\"]' --out gusts",
)
@click.command()
@scenario_argument
@set_option
@code_option
@output_options
@json_option
@margins_option
@click.option(
    "--beside", metavar="FILE", multiple=True, type=click.Path(path_type=Path),
    help="A recording to show beside them, such as one of FlightGear's; may be repeated.",
)  # fmt: skip
def compare(
    scenario: str,
    overrides: tuple[str, ...],
    allow_code: bool,
    output: Output,
    as_json: bool,
    margin_files: tuple[Path, ...],
    beside: tuple[Path, ...],
) -> None:
    """Fly every model and loop of [compare]; write recordings, metrics.json and report.html."""
    from ftc_jsb.cli.progress import progress_for
    from ftc_jsb.loops.code import refuse_code
    from ftc_jsb.report.measured_margins import read_margins
    from ftc_jsb.runs.comparison import compare_and_save
    from ftc_jsb.scenario.load import load_scenario

    flown = load_scenario(scenario, overrides)
    if not allow_code:
        refuse_code(flown.compare.loops, scenario, overrides)
    margins = [read_margins(path) for path in margin_files]
    recorded = _recorded(beside)
    with output.folder(f"compare-{flown.name}") as folder:
        announce(flown, overrides, compared=True)
        flights, interrupted = compare_and_save(flown, folder, progress_for(flown, as_json))
        if taken := set(flights) & set(recorded):
            raise RecordingError(f"--beside: {', '.join(sorted(taken))} is flown here, too")
        files = {label: folder / f"{label}.nc" for label in flights}
        files |= dict(zip(recorded, beside, strict=True))
        write_and_print({**flights, **recorded}, folder, as_json, files, margins=margins)
    if interrupted:
        sys.exit(INTERRUPTED)


def _recorded(paths: tuple[Path, ...]) -> "dict[str, Flight]":
    """Recordings by label.

    Raises:
        RecordingError: one cannot be read, or two have the same label.
    """
    from ftc_jsb.recording.netcdf import load

    found: dict[str, Flight] = {}
    for path in paths:
        flight = load(path)
        if flight.label in found:
            raise RecordingError(f"--beside {path}: a second {flight.label}")
        found[flight.label] = flight
    return found
