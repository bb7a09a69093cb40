"""`compare`: every model with every loop of a scenario, and whether FTC helped."""

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ftc_jsb.api.announcement import compiling, tracked
from ftc_jsb.api.flight import Drawing, Flight
from ftc_jsb.api.scenarios import LoopChoice, flown_scenario, loop_name
from ftc_jsb.api.tables import flat, metrics_html
from ftc_jsb.scenario import schema

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure


class Comparison(Mapping[str, Flight]):
    """Flights of one scenario by label, `<model>-<loop>`."""

    def __init__(self, flights: Mapping[str, Flight]) -> None:
        """Args: at least one, by label."""
        self._flights = dict(flights)

    def __getitem__(self, label: str) -> Flight:
        return self._flights[label]

    def __iter__(self) -> Iterator[str]:
        return iter(self._flights)

    def __len__(self) -> int:
        return len(self._flights)

    @cached_property
    def ftc_helped(self) -> list[dict[str, Any]]:
        """For each pair of flights with FTC and without: helped, no difference or hurt."""
        from ftc_jsb.analysis.ftc_effect import effects

        recorded = {label: flight.recorded for label, flight in self.items()}
        return effects(recorded, {label: flight.metrics for label, flight in self.items()})

    def to_pandas(self) -> "pandas.DataFrame":
        """A row for each flight: its metrics, units in their names."""
        import pandas

        return pandas.DataFrame({label: flat(f.metrics) for label, f in self.items()}).T

    def plot(self, what: Drawing = "states") -> "Figure":
        """A figure of the paper, a column for each model and a line for each loop; as `Flight.plot`."""
        from ftc_jsb.api.drawing import draw

        return draw({label: flight.recorded for label, flight in self.items()}, what)

    def report(self, folder: str | PathLike[str], *, force: bool = False) -> Path:
        """Write the report, its figures and metrics.json; the path of `report.html`.

        Raises:
            RecordingError: the folder is not empty and `force` is not given, or cannot be written.
        """
        from ftc_jsb.api.drawing import report

        return report({label: f.recorded for label, f in self.items()}, folder, force)

    def __repr__(self) -> str:
        """One line."""
        return f"<Comparison of {len(self)} flights: {', '.join(self)}>"

    def _repr_html_(self) -> str:
        """For notebooks."""
        return metrics_html({label: flight.metrics for label, flight in self.items()})


def compare(
    scenario: "str | PathLike[str] | schema.Scenario" = "paper",
    *,
    models: Sequence[str] | None = None,
    loops: Sequence[LoopChoice] | None = None,
    set: Mapping[str, Any] | None = None,  # noqa: A002
    progress: bool | None = None,
) -> Comparison:
    """Fly a scenario with several models and loops; nothing is written.

    Args:
        scenario: as `fly` takes it.
        models: default: the scenario's `compare.models`.
        loops: names or classes; default: the scenario's `compare.loops`.
        set: values by dotted key.
        progress: whether to show a bar; by default on a terminal and in a notebook.

    Raises:
        UserError: as `fly`.
    """
    from ftc_jsb.runs.comparison import variant
    from ftc_jsb.simulation.fly import fly

    changes = dict(set or {})
    if models is not None:
        changes["compare.models"] = list(models)
    if loops is not None:
        changes["compare.loops"] = [loop_name(loop) for loop in loops]
    base = flown_scenario(scenario, None, None, changes)
    variants = [variant(base, m, loop) for m in base.compare.models for loop in base.compare.loops]
    compiling(variants)
    flights = (Flight(fly(each)) for each in tracked(variants, "Flights", progress))
    return Comparison({flight.label: flight for flight in flights})
