"""How far a long task is, how long it will take, and what it is at: a bar on a terminal, nothing elsewhere."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from ftc_jsb.cli.printing import is_quiet, progress_line

Show = Callable[[int, int, str], None]  # steps done, of how many, what is done now


@contextmanager
def task_bar(title: str, shown: bool = True) -> Iterator[Show]:
    """A bar with the time left, gone when the task is over.

    Args:
        title: what is done.
        shown: whether anybody wants it; --quiet and what is no terminal have none anyway.
    """
    if not (shown and _on_terminal()) or is_quiet():
        yield lambda done, total, text: None
        return
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    bar = Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
        TextColumn("{task.fields[text]}", style="dim"),
        console=Console(stderr=True),
        transient=True,
    )
    with bar:
        task = bar.add_task(title, total=None, text="")
        yield lambda done, total, text: bar.update(task, completed=done, total=total, text=text)


@contextmanager
def step_bar(title: str, steps: int, lines: bool = True) -> Iterator[Callable[[str], None]]:
    """A `task_bar` for a task that says what it begins.

    Args:
        title: what is done.
        steps: how often it will say something.
        lines: whether what it says is printed, a line each, where there is no terminal for a bar.
    """
    if not _on_terminal():
        yield progress_line if lines else lambda text: None
        return
    begun = 0
    with task_bar(title) as show:

        def tell(text: str) -> None:
            nonlocal begun
            show(begun, steps, text)
            begun += 1

        yield tell


def _on_terminal() -> bool:
    return sys.stderr.isatty()
