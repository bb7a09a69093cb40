"""`ftc-jsb check`: a scenario seen through without flying."""

import click

from ftc_jsb.cli.announcement import note
from ftc_jsb.cli.options import code_option, examples, scenario_argument, set_option


@examples(
    "ftc-jsb check my.toml",
)
@click.command()
@scenario_argument
@set_option
@code_option
def check(scenario: str, overrides: tuple[str, ...], allow_code: bool) -> None:
    """Read and validate a scenario, its aircraft and its loops, without flying."""
    from ftc_jsb.runs.check import check_scenario
    from ftc_jsb.scenario.load import load_scenario

    flown = load_scenario(scenario, overrides)
    for line in check_scenario(flown, allow_code):
        click.echo(line)
    note(flown)
