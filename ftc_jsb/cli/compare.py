"""`ftc-jsb compare`: every model with every loop of a scenario, and the report."""

import sys
from pathlib import Path

import click

from ftc_jsb.cli.exit_codes import INTERRUPTED
from ftc_jsb.cli.options import (
    force_option,
    json_option,
    margins_option,
    out_option,
    scenario_argument,
    set_option,
)
from ftc_jsb.cli.results import margins_of, write_results
from ftc_jsb.cli.scenario import announce, load, progress_for


@click.command()
@scenario_argument
@set_option
@out_option
@force_option
@json_option
@margins_option
def compare(
    scenario: str,
    overrides: tuple[str, ...],
    out: Path | None,
    force: bool,
    as_json: bool,
    margin_files: tuple[Path, ...],
) -> None:
    """Fly every model and loop of [compare]; write recordings, metrics.json and report.html."""
    from ftc_jsb.runs.comparison import compare_and_save
    from ftc_jsb.runs.output_folder import output_folder

    flown = load(scenario, overrides)
    margins = margins_of(margin_files)
    with output_folder(out, f"compare-{flown.name}", force) as folder:
        announce(flown)
        flights, interrupted = compare_and_save(flown, folder, progress_for(flown, as_json))
        write_results(flights, folder, as_json, margins=margins)
    if interrupted:
        sys.exit(INTERRUPTED)
