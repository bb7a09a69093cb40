"""`ftc-jsb inner-loop`: inner loops designed, flown and judged."""

import sys

import click

from ftc_jsb.cli.exit_codes import DONE, LIMIT_BROKEN
from ftc_jsb.cli.options import Output, examples, output_options
from ftc_jsb.cli.printing import message, progress_line


@examples(
    "ftc-jsb inner-loop MD11 --out md11",
    "ftc-jsb inner-loop f16 f15 --report",
)
@click.command("inner-loop")
@click.argument("aircraft", metavar="AIRCRAFT...", nargs=-1, required=True)
@click.option("--report", "judge", is_flag=True, help="Fly and judge the steps; design nothing.")
@output_options
def inner_loop(aircraft: tuple[str, ...], judge: bool, output: Output) -> None:
    """Design the inner loop of each AIRCRAFT: write inner_loop.xml, the steps' table and figure.

    AIRCRAFT is a shipped one, a folder with aircraft.toml, or an aircraft of the installed jsbsim
    package, such as T37, whose aircraft.toml is drafted. One folder for each in DIR; with --report
    only table and figures, all in DIR. Exit code 1 where a step misses a criterion of its class.
    """
    from ftc_jsb.report.inner_loop_output import (
        design_and_report,
        loaded_or_drafted,
        report_steps,
    )

    with output.folder("inner-loop") as folder:
        loaded = [loaded_or_drafted(name, folder, progress_line) for name in aircraft]
        if not judge:
            loaded = design_and_report(loaded, folder, progress_line)
        table, missed = report_steps(loaded, folder)
        click.echo(table)
    click.echo(f"Written: {folder}")
    for what in missed:
        message(f"not good enough: {what}")
    sys.exit(LIMIT_BROKEN if missed else DONE)
