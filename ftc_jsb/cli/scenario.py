"""Scenarios as verbs take them: loaded with overrides, announced, with progress."""

import json
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from ftc_jsb.scenario.schema import Scenario


def load(name: str, overrides: Sequence[str]) -> "Scenario":
    """A scenario by name or path, with `--set` applied."""
    from ftc_jsb.scenario.load import load_scenario

    return load_scenario(name, overrides)


def with_model_and_loop(
    overrides: tuple[str, ...], model: str | None, loop: str | None
) -> list[str]:
    """Overrides with those that `--model` and `--loop` stand for."""
    extra = [f'model="{model}"'] if model else []
    extra += [f"loop.name={json.dumps(loop)}"] if loop else []
    return [*overrides, *extra]


def print_notes(scenario: "Scenario") -> None:
    """Print what is allowed in a scenario but seldom meant."""
    from ftc_jsb.scenario.notes import notes

    for note in notes(scenario):
        click.echo(f"ftc-jsb: note: {note}", err=True)


def announce(scenario: "Scenario") -> None:
    """Print notes, and that kernels are compiled where that is to come."""
    print_notes(scenario)
    from ftc_jsb.compiled import is_first_run

    if is_first_run("ftc_jsb.simulation.sample"):
        click.echo(
            "Compiling the numerical kernels (first run only, about half a minute) ...", err=True
        )


def progress_for(scenario: "Scenario", quiet: bool) -> Any:
    """A progress bar on a terminal."""
    from ftc_jsb.cli.progress import Progress

    return Progress(scenario, enabled=sys.stderr.isatty() and not quiet)
