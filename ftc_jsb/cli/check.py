"""`ftc-jsb check`: a scenario read and validated, without flying."""

import click

from ftc_jsb.cli.options import set_option
from ftc_jsb.cli.scenario import load, print_notes


@click.command()
@click.argument("file", metavar="SCENARIO")
@set_option
def check(file: str, overrides: tuple[str, ...]) -> None:
    """Read and validate a scenario, its aircraft and its loops, without flying."""
    from ftc_jsb.runs.check import check_scenario

    flown = load(file, overrides)
    for line in check_scenario(flown):
        click.echo(line)
    print_notes(flown)
