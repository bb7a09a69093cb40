"""`ftc-jsb compare`: every model and loop of a scenario, and their report."""

import sys
from pathlib import Path

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
def compare(
    scenario: str,
    overrides: tuple[str, ...],
    allow_code: bool,
    output: Output,
    as_json: bool,
    margin_files: tuple[Path, ...],
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
    with output.folder(f"compare-{flown.name}") as folder:
        announce(flown, overrides, compared=True)
        flights, interrupted = compare_and_save(flown, folder, progress_for(flown, as_json))
        files = {label: folder / f"{label}.nc" for label in flights}
        write_and_print(flights, folder, as_json, files, margins=margins)
    if interrupted:
        sys.exit(INTERRUPTED)
