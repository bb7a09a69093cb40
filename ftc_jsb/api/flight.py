"""A flight as a user of the package holds it: numbers, tables, figures, report, and its other futures."""

from collections.abc import Mapping
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy.typing as npt

from ftc_jsb.api.overrides import override_texts
from ftc_jsb.api.scenarios import Scenario
from ftc_jsb.api.scenarios import scenario as typed
from ftc_jsb.api.tables import metrics_html
from ftc_jsb.errors import ScenarioError, WriteError
from ftc_jsb.recording import flight as recording

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure

Drawing = Literal["states", "controls", "errors", "trajectory", "effectiveness"]


class Flight:
    """A flown scenario, as `fly` and `load` give it. It does not change."""

    def __init__(self, flown: recording.Flight) -> None:
        """Args: the flight as it was recorded."""
        self._flown = flown

    @property
    def recorded(self) -> recording.Flight:
        """The flight as the rest of the package takes it."""
        return self._flown

    @cached_property
    def scenario(self) -> Scenario:
        """What was flown."""
        return typed(self._flown.scenario)

    @property
    def label(self) -> str:
        """`<model>-<loop>`."""
        return self._flown.label

    @property
    def record(self) -> npt.NDArray[Any]:
        """(rows,) structured array of every recorded variable, SI and rad, one row a sample."""
        return self._flown.record

    @property
    def outcome(self) -> recording.Outcome:
        """How the flight ended, when [s], and why if it was not complete."""
        return self._flown.outcome

    @cached_property
    def metrics(self) -> dict[str, Any]:
        """The flight's entry in `metrics.json` (docs/scenarios.md); units are in the keys."""
        from ftc_jsb.analysis.metrics import flight_metrics

        return flight_metrics(self._flown)

    @property
    def verdict(self) -> str:
        """Inside limits, limits broken, loss of control, departed, failed or interrupted."""
        return str(self.metrics["verdict"])

    @property
    def passed(self) -> bool:
        """Whether it ended as planned, in control, inside every limit."""
        from ftc_jsb.analysis.verdict import passed

        return passed(self.metrics)

    def to_xarray(self) -> "xarray.Dataset":
        """Every variable along `time`, with units and meaning; the scenario in the attributes."""
        from ftc_jsb.recording.dataset import to_dataset

        return to_dataset(self._flown)

    def to_pandas(self) -> "pandas.DataFrame":
        """A column for each variable, SI and rad, over time [s]; units in `frame.attrs["units"]`."""
        import pandas

        from ftc_jsb.recording.columns import VARIABLES

        frame = pandas.DataFrame(
            {name: self.record[name] for name in self.record.dtype.names or ()}
        )
        frame.attrs["units"] = {variable.name: variable.unit for variable in VARIABLES}
        return frame.set_index("time")

    def save(self, path: str | PathLike[str], *, force: bool = False) -> Path:
        """Write the flight as NetCDF, from which `load` and `ftc-jsb` read it back.

        Raises:
            WriteError: the file exists and `force` is not given, or it cannot be written.
        """
        from ftc_jsb.recording.netcdf import save

        where = Path(path)
        if where.exists() and not force:
            raise WriteError(where, "it exists; give another path, or force=True")
        save(self._flown, where)
        return where

    def plot(self, what: Drawing = "states") -> "Figure":
        """A figure of the paper.

        Args:
            what: states with their references, controls, tracking errors, the trajectory, or the
                effectiveness and its estimate.

        Raises:
            ValueError: no such figure, or the flight has no data for it.
        """
        from ftc_jsb.api.drawing import draw

        return draw({self.label: self._flown}, what)

    def report(self, folder: str | PathLike[str], *, force: bool = False) -> Path:
        """Write the report, its figures and metrics.json; the path of `report.html`.

        Raises:
            RecordingError: the folder is not empty and `force` is not given, or cannot be written.
        """
        from ftc_jsb.api.drawing import report

        return report({self.label: self._flown}, folder, force)

    def at(self, time: float) -> "Moment":
        """A moment of the flight.

        Args:
            time: after its start and before its end [s].

        Raises:
            ScenarioError: outside the flight.
        """
        return Moment(self, time)

    def __repr__(self) -> str:
        """One line."""
        return (
            f"<Flight {self._flown.scenario.name!r} {self.label}: {self.outcome.time:g} s, "
            f"{self.verdict}>"
        )

    def _repr_html_(self) -> str:
        """For notebooks."""
        return metrics_html({self.label: self.metrics})


class Moment:
    """A moment of a flight, from which it can be flown on otherwise."""

    def __init__(self, flight: Flight, time: float) -> None:
        """Args: the flight; the moment [s], taken to the nearest sample."""
        flown = flight.recorded
        rate = flown.scenario.loop.rate
        self._flight = flight
        self._row = round(time * rate)
        if not 1 <= self._row < flown.outcome.time * rate:
            raise ScenarioError(
                f"at({time:g}): not inside the flight; expected more than 0 and less than "
                f"{flown.outcome.time:g} s"
            )

    @property
    def time(self) -> float:
        """Of the sample [s]."""
        return self._row / self._flight.recorded.scenario.loop.rate

    @property
    def state(self) -> dict[str, float]:
        """Every recorded variable at this moment, SI and rad; of a thinned recording the row before."""
        record = self._flight.record
        row = record[int(record["time"].searchsorted(self.time + 1e-9)) - 1]
        return {name: float(row[name]) for name in record.dtype.names or ()}

    def branch(self, *, set: Mapping[str, Any] | None = None) -> Flight:  # noqa: A002
        """Another future from this moment on.

        JSBSim cannot be restored exactly in mid-flight, so the flight is flown again up to here: its
        samples before are the same to the bit, on every model, and what is changed is recorded as a
        command, so that the branch can be saved, loaded and replayed.

        Args:
            set: values by dotted key that hold from now on: of `fault`, of `loop` (numbers) and the
                breakpoints of `reference`. A fault keeps its own start, also one that lies before now.

        Raises:
            ScenarioError: a key or value that cannot be, or that cannot change in flight.
        """
        from ftc_jsb.recording.commands import Applied, ChangeScenario
        from ftc_jsb.simulation.changed_scenario import changed_scenario
        from ftc_jsb.simulation.command_source import RecordedCommands
        from ftc_jsb.simulation.fly import fly

        flown = self._flight.recorded
        change = ChangeScenario(overrides=tuple(override_texts(set or {})))
        changed_scenario(flown.scenario, change.overrides)  # refused before it is flown
        before = [entry for entry in flown.commands if entry.row <= self._row]
        commands = RecordedCommands([*before, Applied(self._row, change)])
        return Flight(fly(flown.scenario, commands=commands))

    def __repr__(self) -> str:
        """One line."""
        return f"<{self.time:g} s of {self._flight!r}>"
