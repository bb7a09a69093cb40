"""What is said before a flight: notes on the scenario, and that kernels will be compiled."""

from typing import TYPE_CHECKING

from ftc_jsb.cli import printing

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ftc_jsb.scenario.schema import Scenario


def note(scenario: "Scenario") -> None:
    """Say what is worth knowing about a scenario."""
    from ftc_jsb.scenario.notes import notes

    for text in notes(scenario):
        printing.note(text)


def announce(scenario: "Scenario", overrides: "Sequence[str]" = (), compared: bool = False) -> None:
    """Say what is worth knowing before a scenario is flown.

    Args:
        scenario: to be flown.
        overrides: `key=value`, by which it differs from its file.
        compared: its models and loops of [compare] are flown, in place of its own.
    """
    note(scenario)
    if overrides:
        _unused(scenario, overrides, compared)
    compiling()


def _unused(scenario: "Scenario", overrides: "Sequence[str]", compared: bool) -> None:
    from ftc_jsb.runs.unused_keys import unused_keys

    models, loops = [scenario.model], [scenario.loop]
    if compared:
        models = list(scenario.compare.models)
        loops = [scenario.loop.model_copy(update={"name": n}) for n in scenario.compare.loops]
    for text in unused_keys(overrides, models, loops):
        printing.note(text)


def compiling() -> None:
    """Compile the kernels if they have yet to be, and say so."""
    from ftc_jsb.warm import is_cold, warm

    if is_cold():
        printing.progress_line("First run: the numerical kernels are compiled, once.")
        warm(printing.progress_line)
