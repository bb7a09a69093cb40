"""What is said before a flight: notes on the scenario, and that kernels will be compiled."""

from typing import TYPE_CHECKING

from ftc_jsb.cli.printing import message, progress_line

if TYPE_CHECKING:
    from ftc_jsb.scenario.schema import Scenario


def note(scenario: "Scenario") -> None:
    """Say what is worth knowing about a scenario."""
    from ftc_jsb.scenario.notes import notes

    for text in notes(scenario):
        message(f"note: {text}")


def announce(scenario: "Scenario") -> None:
    """Say what is worth knowing before a scenario is flown."""
    note(scenario)
    compiling()


def compiling() -> None:
    """Say that kernels will be compiled, if they have yet to be."""
    from ftc_jsb.compiled import is_first_run

    if is_first_run("ftc_jsb.simulation.sample"):
        progress_line("Compiling the numerical kernels (first run only, about half a minute) ...")
