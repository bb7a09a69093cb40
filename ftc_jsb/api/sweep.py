"""`sweep`: a table of flights over a grid of values."""

import itertools
from collections.abc import Iterator, Mapping, Sequence
from os import PathLike
from typing import TYPE_CHECKING, Any, NamedTuple

from ftc_jsb.api.announcement import compiling, tracked
from ftc_jsb.api.flight import Flight
from ftc_jsb.api.scenarios import LoopChoice, flown_scenario
from ftc_jsb.api.tables import flat
from ftc_jsb.errors import UserError
from ftc_jsb.scenario import schema

if TYPE_CHECKING:
    import pandas


class Case(NamedTuple):
    """A flight of a sweep."""

    values: dict[str, Any]  # by dotted key
    scenario: schema.Scenario


class Sweep:
    """A table of flights: what was varied, model, loop, verdict and every metric."""

    def __init__(self, cases: Sequence[Case], table: "pandas.DataFrame") -> None:
        """Args: what was flown; a row for each."""
        self._cases = tuple(cases)
        self.table = table

    def __len__(self) -> int:
        return len(self._cases)

    def flight(self, row: int) -> Flight:
        """The flight of a row, flown again, the same to the bit: a sweep keeps numbers only.

        Raises:
            IndexError: no such row.
            UserError: it cannot be flown, as the row's `error` says.
        """
        from ftc_jsb.simulation.fly import fly

        return Flight(fly(self._cases[row].scenario))

    def to_pandas(self) -> "pandas.DataFrame":
        """The table."""
        return self.table

    def __repr__(self) -> str:
        """One line."""
        varied = ", ".join(self._cases[0].values) if self._cases else ""
        return f"<Sweep of {len(self)} flights over {varied}>"

    def _repr_html_(self) -> str:
        """For notebooks."""
        return str(self.table._repr_html_())


def sweep(
    scenario: "str | PathLike[str] | schema.Scenario",
    values: Mapping[str, Sequence[Any]],
    *,
    models: Sequence[str] | None = None,
    loops: Sequence[LoopChoice] | None = None,
    set: Mapping[str, Any] | None = None,  # noqa: A002
    progress: bool | None = None,
) -> Sweep:
    """Fly every combination of values, models and loops. For thousands of flights see `campaign`.

    Args:
        scenario: as `fly` takes it.
        values: by dotted key, each a list: `{"fault[0].effectiveness": [0.4, 0.5, 0.6]}`.
        models: default: the scenario's model alone.
        loops: names or classes; default: the scenario's loop alone.
        set: values by dotted key that hold in every flight.
        progress: whether to show a bar; by default on a terminal and in a notebook.

    Returns:
        A row for each flight, also for one that could not be flown, whose `error` says why.

    Raises:
        UserError: no such scenario, key, value, model or loop; before anything is flown.
    """
    import pandas

    cases = list(_cases(flown_scenario(scenario, None, None, set), values, models, loops))
    compiling([case.scenario for case in cases])
    rows = [_row(case) for case in tracked(cases, "Flights", progress)]
    return Sweep(cases, pandas.DataFrame(rows))


def _cases(
    base: schema.Scenario,
    values: Mapping[str, Sequence[Any]],
    models: Sequence[str] | None,
    loops: Sequence[LoopChoice] | None,
) -> Iterator[Case]:
    for chosen in itertools.product(*values.values()):
        point = dict(zip(values, chosen, strict=True))
        for model in models or (None,):
            for loop in loops or (None,):
                yield Case(point, flown_scenario(base, model, loop, point))


def _row(case: Case) -> dict[str, Any]:
    from ftc_jsb.analysis.metrics import flight_metrics
    from ftc_jsb.simulation.fly import fly

    head = {**case.values, "model": case.scenario.model, "loop": case.scenario.loop.name}
    try:
        metrics = flat(flight_metrics(fly(case.scenario)))
    except UserError as error:
        return {**head, "verdict": None, "error": str(error)}
    return {**head, "verdict": metrics.pop("verdict"), "error": None, **metrics}
