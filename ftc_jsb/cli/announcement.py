"""What is said before a flight: notes on the scenario, and that kernels will be compiled."""

from typing import TYPE_CHECKING

from ftc_jsb.cli import printing

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ftc_jsb.scenario.loop import Loop
    from ftc_jsb.scenario.schema import Scenario


def note(scenario: "Scenario") -> None:
    """Say what is worth knowing about a scenario."""
    from ftc_jsb.scenario.notes import notes

    for text in notes(scenario):
        printing.note(text)


def announce(scenario: "Scenario", overrides: "Sequence[str]" = (), compared: bool = False) -> None:
    """Say what is worth knowing before a scenario is flown, and compile what its flights need.

    Args:
        scenario: to be flown.
        overrides: `key=value`, by which it differs from its file.
        compared: its models and loops of [compare] are flown, in place of its own.
    """
    from ftc_jsb.warm import Flown, needs

    note(scenario)
    models, loops = [scenario.model], [scenario.loop]
    if compared:
        models = list(scenario.compare.models)
        loops = [scenario.loop.model_copy(update={"name": n}) for n in scenario.compare.loops]
    if overrides:
        _unused(overrides, models, loops)
    compiling(needs(Flown(model, loop) for model in models for loop in loops))


def _unused(overrides: "Sequence[str]", models: "Sequence[str]", loops: "Sequence[Loop]") -> None:
    from ftc_jsb.runs.unused_keys import unused_keys

    for text in unused_keys(overrides, models, loops):
        printing.note(text)


def compiling(wanted: "Sequence[str] | None" = None) -> None:
    """Compile kernels that have yet to be, and show how far that is.

    Args:
        wanted: what `warm.needs` gave; None for every flight's.
    """
    from ftc_jsb.cli.task_bar import task_bar
    from ftc_jsb.warm import EVERYTHING, is_cold, warm

    needed = EVERYTHING if wanted is None else wanted
    if is_cold(needed):
        printing.progress_line("First run: the numerical kernels are compiled, once.")
        with task_bar("Compiling") as show:
            warm(show, needed)
