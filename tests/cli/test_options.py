"""Options that a command gets as one argument."""

from typing import NamedTuple

import click
from click.testing import CliRunner

from ftc_jsb.cli.options import grouped


class Place(NamedTuple):
    altitude: float
    name: str


@click.command()
@click.option("--first")
@grouped(
    "place",
    Place,
    click.option("--altitude", type=float, default=3.0),
    click.option("--name", default="here"),
)
@click.option("--last")
def program(first, place, last):
    """What the program does."""
    click.echo((first, place, last))


def test_options_come_as_one_argument():
    given = CliRunner().invoke(program, ["--first", "a", "--altitude", "5", "--last", "z"])
    assert given.output == f"{('a', Place(5.0, 'here'), 'z')}\n"


def test_help_keeps_order_and_text():
    shown = CliRunner().invoke(program, ["--help"]).output
    places = [shown.index(name) for name in ("--first", "--altitude", "--name", "--last")]
    assert places == sorted(places)
    assert "What the program does." in shown
