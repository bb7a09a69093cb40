"""A flight: its scenario, its recording and how it ended."""

from typing import Any, Literal, NamedTuple

import numpy.typing as npt

from ftc_jsb.recording.commands import Applied
from ftc_jsb.recording.provenance import Provenance
from ftc_jsb.scenario.schema import Scenario


class Outcome(NamedTuple):
    """How a flight ended, when [s], and why if it was not complete."""

    status: Literal["complete", "ended", "departed", "failed", "interrupted"]
    time: float
    reason: str


class Flight(NamedTuple):
    """A flown scenario."""

    scenario: Scenario
    record: npt.NDArray[Any]  # (rows,) of `columns.ROW`
    outcome: Outcome
    real_time_factor: float | None  # None for a recording that was read back
    commands: tuple[Applied, ...] = ()  # given in flight
    provenance: Provenance | None = None  # of a recording that was read back; None: flown here

    @property
    def row_period(self) -> float:
        """Time between two rows [s]: a sample's, or several where the recording was thinned."""
        if self.record.size < 2:
            return 1.0 / self.scenario.loop.rate
        time = self.record["time"]
        if self.scenario.model == "flightgear":  # samples came when they came: the mean
            return float(time[-1] - time[0]) / (time.size - 1)
        return float(time[1] - time[0])

    @property
    def label(self) -> str:
        """`<model>-<loop>`, the flight's name in reports and files."""
        return f"{self.scenario.model}-{self.scenario.loop.name.replace(':', '.')}"
