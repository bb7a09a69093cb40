"""What a user of the package is told while something takes long: a line in a terminal, a bar in a notebook."""

import sys
from collections.abc import Iterable, Iterator, Sequence, Sized
from html import escape
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from ftc_jsb.scenario.schema import Scenario

Item = TypeVar("Item")


def compiling(scenarios: "Iterable[Scenario] | None" = None) -> None:
    """Compile kernels that have yet to be, and say so: a bar where somebody looks, else a line.

    Args:
        scenarios: that will be flown; None for any.
    """
    from ftc_jsb.warm import EVERYTHING, Flown, is_cold, needs, warm

    wanted: Sequence[str] = EVERYTHING
    if scenarios is not None:
        wanted = needs(Flown(each.model, each.loop) for each in scenarios)
    if not is_cold(wanted):
        return
    bar = Bar("Compiling the numerical kernels, once")
    if not bar.shown:
        print("Compiling the numerical kernels, once ...", file=sys.stderr, flush=True)
    try:
        warm(bar.show, wanted)
    finally:
        bar.close()


class Bar:
    """How far a long task is: a bar in a notebook, a line on a terminal, nothing elsewhere."""

    def __init__(self, title: str, total: int | None = None, shown: bool | None = None) -> None:
        """Args: what is done; in how many steps, if known; None shows it where somebody looks."""
        self._title, self._total, self._done = title, total, 0
        self._notebook: Any = None
        looked_at = sys.stderr.isatty() or in_notebook()
        self._shown = looked_at if shown is None else shown
        if self._shown and in_notebook():
            from IPython.display import HTML, display

            self._html: Any = HTML
            self._notebook = display(HTML(self._page("")), display_id=True)

    @property
    def shown(self) -> bool:
        """Whether anybody sees it."""
        return self._shown

    def show(self, done: int, total: int, text: str) -> None:
        """So many steps are done, of so many, and what is done now."""
        self._done, self._total = done - 1, total
        self.step(text)

    def step(self, text: str = "") -> None:
        """One step is done, or what is done now."""
        self._done += 1
        if self._notebook is not None:
            self._notebook.update(self._html(self._page(text)))
        elif self._shown:
            print(
                f"\r\033[K{self._title}: {self._count()} {text}",
                end="",
                file=sys.stderr,
                flush=True,
            )

    def close(self) -> None:
        """The task is over: the bar goes."""
        if self._notebook is not None:
            self._notebook.update(self._html(""))
        elif self._shown:
            print("\r\033[K", end="", file=sys.stderr, flush=True)

    def _count(self) -> str:
        return str(self._done) if self._total is None else f"{self._done} of {self._total}"

    def _page(self, text: str) -> str:
        value = "" if self._total is None else f'value="{self._done}" max="{self._total}"'
        return f"{escape(self._title)} <progress {value}></progress> {self._count()} {escape(text)}"


def tracked(items: Iterable[Item], title: str, shown: bool | None = None) -> Iterator[Item]:
    """The items one after the other, with a `Bar`."""
    total = len(items) if isinstance(items, Sized) else None
    bar = Bar(title, total, shown)
    try:
        for item in items:
            yield item
            bar.step()
    finally:
        bar.close()


def in_notebook() -> bool:
    """Whether this runs in a Jupyter kernel."""
    if "IPython" not in sys.modules:
        return False
    from IPython import get_ipython

    return type(get_ipython()).__name__ == "ZMQInteractiveShell"
