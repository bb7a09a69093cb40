"""A progress bar on a terminal, as an observer of flights."""

import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy.typing as npt

from ftc_jsb.cli.printing import is_quiet
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.fly import Observer

EVERY = 50  # samples between updates


class Progress:
    """Called with the label of a flight, gives the observers that show how far it is."""

    def __init__(self, scenario: Scenario, enabled: bool) -> None:
        """Args: what is flown; whether to show anything."""
        self._scenario = scenario
        self._enabled = enabled

    @contextmanager
    def __call__(self, label: str) -> Iterator[Sequence[Observer]]:
        """Observers for one flight; the bar is gone when the flight is over, however it ended."""
        if not self._enabled:
            yield ()
            return
        from rich.console import Console
        from rich.progress import Progress as Bar
        from rich.progress import TextColumn, TimeElapsedColumn

        columns = (*Bar.get_default_columns(), TextColumn("{task.fields[seconds]} s flown"))
        bar = Bar(*columns, TimeElapsedColumn(), console=Console(stderr=True), transient=True)
        samples = self._scenario.samples
        shown = [0]
        task = bar.add_task(label, total=samples, seconds="0")

        def observe(record: npt.NDArray[Any], i: int) -> None:
            if i - shown[0] >= EVERY:
                shown[0] = i
                bar.update(task, completed=i, seconds=f"{record[i]['time']:.0f}")

        observe.coarse = True  # type: ignore[attr-defined]
        with bar:
            yield (observe,)


def progress_for(scenario: Scenario, quiet: bool) -> Progress:
    """A progress bar if there is a terminal to show it, and nobody wants quiet."""
    return Progress(scenario, enabled=sys.stderr.isatty() and not quiet and not is_quiet())
