"""Events of a flight for STATUSTEXT: faults and limits, from the rows that have been flown."""

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.analysis.default_limits import flight_limits
from ftc_jsb.analysis.limits import limited_variables
from ftc_jsb.analysis.loss_of_control import loss_of_control
from ftc_jsb.disturbance.faults import ENGINE_OUT, HEALTHY, HELD, TIME_TOLERANCE
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.vocabulary.channels import CHANNELS, ENGINES, SURFACES
from ftc_jsb.vocabulary.hypotheses import NOBODY, hypothesis
from ftc_jsb.vocabulary.signals import SENSED

FULL_EFFECTIVENESS = 1.0 - 1e-9  # effectiveness below which there is a fault
EFFECTIVENESS_STEP = 0.02  # change from one sample to the next that is an event
NEAR_LIMIT = 0.05  # of a limit's range: this close to its end is near
SETTLED_CHANGE = 0.01  # an estimate that moves less than this ...
SETTLING_TIME = 0.5  # ... in this time [s] has isolated the fault
LOOKBACK = 10.0  # [s] of flight in which loss of control is looked for, at each search
LONGEST_TEXT = 50  # characters

NOTICE, WARNING = dialect.MAV_SEVERITY_NOTICE, dialect.MAV_SEVERITY_WARNING
CRITICAL = dialect.MAV_SEVERITY_CRITICAL


STATE_NAMES = {ENGINE_OUT: "out", HELD: "stuck"}
SCHEDULED = (  # name, column, whether it is a state rather than an effectiveness
    *((channel.replace("_", " "), f"effectiveness_{channel}", False) for channel in CHANNELS),
    *((surface, f"{surface}_effectiveness", False) for surface in SURFACES),
    *((f"engine {number + 1}", f"engine_{number}_state", True) for number in range(ENGINES)),
    *((surface, f"{surface}_state", True) for surface in SURFACES),
)


class Event(NamedTuple):
    """Something worth a line on the ground station."""

    row: int
    severity: int
    text: str


class FlightEvents:
    """Finds the events of rows, which are given in order and once each."""

    def __init__(self, scenario: Scenario) -> None:
        """Args: what is flown."""
        self._limits = flight_limits(scenario)
        self._sensor_faults = [f for f in scenario.fault if f.target in SENSED]
        self._margin = scenario.loop.detector.margin
        self._window = max(1, round(SETTLING_TIME * scenario.loop.rate))
        self._limit_levels: dict[str, int] = {}  # 0 inside, 1 near, 2 broken
        self._isolated = self._lost = False
        self._lookback = round(LOOKBACK * scenario.loop.rate)

    @property
    def critical(self) -> bool:
        """Whether a limit is broken in the last row of those, or control was lost."""
        return self._lost or 2 in self._limit_levels.values()

    def find(self, record: npt.NDArray[Any], first: int, beyond: int) -> list[Event]:
        """Events of rows `first` to `beyond - 1`, in their order."""
        found = [
            *self._schedule_events(record, first, beyond),
            *self._sensor_events(record, first, beyond),
            *self._detector_events(record, first, beyond),
            *self._suspicion_events(record, first, beyond),
            *self._attainment_events(record, first, beyond),
            *self._limit_events(record[first:beyond], first),
            *self._loss_events(record, first, beyond),
        ]
        return sorted(found, key=lambda event: event.row)

    def _schedule_events(
        self, record: npt.NDArray[Any], first: int, beyond: int
    ) -> Iterator[Event]:
        """Onsets, jumps and ends of what stands in the schedule."""
        for name, column, is_state in SCHEDULED:
            sound = HEALTHY if is_state else 1.0
            values = np.nan_to_num(record[column][max(first - 1, 0) : beyond], nan=sound)
            if first == 0:
                values = np.concatenate(([sound], values))
            before, now = values[:-1], values[1:]
            faulty = now != sound if is_state else now < FULL_EFFECTIVENESS
            changed = np.abs(now - before) > (0.0 if is_state else EFFECTIVENESS_STEP)
            was = before != sound if is_state else before < FULL_EFFECTIVENESS
            for k in np.flatnonzero((faulty & (changed | ~was)) | (~faulty & was)):
                if faulty[k]:
                    what = (
                        STATE_NAMES.get(int(now[k]), "hard over") if is_state else f"{now[k]:.2f}"
                    )
                    yield Event(first + int(k), WARNING, f"fault injected: {name} {what}")
                else:
                    yield Event(first + int(k), NOTICE, f"fault removed: {name}")

    def _sensor_events(self, record: npt.NDArray[Any], first: int, beyond: int) -> Iterator[Event]:
        """Onsets and ends of the scenario's faults of sensors, which stand in no column."""
        times = record["time"][first:beyond]
        for fault in self._sensor_faults:
            for when, text in (
                (fault.start, f"fault injected: {fault.target} {fault.kind}"),
                (fault.end, f"fault removed: {fault.target}"),
            ):
                if when is None:
                    continue
                k = int(np.searchsorted(times, when - TIME_TOLERANCE))
                new = first == 0 or record["time"][first - 1] < when - TIME_TOLERANCE
                if k < times.size and new:
                    yield Event(first + k, WARNING, text)

    def _detector_events(
        self, record: npt.NDArray[Any], first: int, beyond: int
    ) -> Iterator[Event]:
        """Declarations of the detector, and what is isolated."""
        declared = record["fault_declared"][max(first - 1, 0) : beyond] > 0.5
        if first == 0:
            declared = np.concatenate(([False], declared))
        for k in range(first, beyond):
            before, now = declared[k - first], declared[k - first + 1]
            if now and not before:
                self._isolated = False
                yield Event(k, WARNING, "fault detected")
            elif before and not now:
                yield Event(k, NOTICE, "recovered: no fault declared")
            if now and not self._isolated and k >= self._window:
                text = self._isolation(record[k], record[k - self._window])
                if text:
                    self._isolated = True
                    yield Event(k, WARNING, text)

    def _suspicion_events(
        self, record: npt.NDArray[Any], first: int, beyond: int
    ) -> Iterator[Event]:
        """Whose fault it is believed to be, with its probability."""
        suspect = np.nan_to_num(record["suspect"][max(first - 1, 0) : beyond]).astype(int)
        if first == 0:
            suspect = np.concatenate(([NOBODY], suspect))
        for k in np.flatnonzero(suspect[1:] != suspect[:-1]):
            i = first + int(k)
            who = hypothesis(suspect[k + 1]).replace("_", " ")
            if suspect[k + 1] == NOBODY:
                yield Event(i, NOTICE, "nobody is suspect any more")
            else:
                sure = float(record[i]["suspect_probability"])
                yield Event(i, WARNING, f"suspect: {who}, probability {sure:.2f}"[:LONGEST_TEXT])

    def _attainment_events(
        self, record: npt.NDArray[Any], first: int, beyond: int
    ) -> Iterator[Event]:
        """References that cannot be flown, and that can be again."""
        short = record["unattainable"][max(first - 1, 0) : beyond] > 0.5
        if first == 0:
            short = np.concatenate(([False], short))
        for k in np.flatnonzero(short[1:] != short[:-1]):
            i = first + int(k)
            if short[k + 1]:
                off = float(record[i]["airspeed"] - record[i]["airspeed_ref"])
                path = math.degrees(record[i]["climb_given_up"])
                text = f"references not attainable: {off:+.1f} m/s, path -{path:.1f} deg"
                yield Event(i, WARNING, text[:LONGEST_TEXT])
            else:
                yield Event(i, NOTICE, "references attainable again")

    def _loss_events(self, record: npt.NDArray[Any], first: int, beyond: int) -> Iterator[Event]:
        """The first loss of control."""
        if self._lost or beyond < 2:
            return
        lost = loss_of_control(record[max(min(first, beyond - self._lookback), 0) : beyond])
        if lost is not None:
            self._lost = True
            row = int(np.searchsorted(record["time"][:beyond], lost.time - TIME_TOLERANCE))
            yield Event(max(row, first), CRITICAL, f"control lost: {lost.kind}"[:LONGEST_TEXT])

    def _isolation(self, row: Any, before: Any) -> str:
        """Which channel has lost how much, once the estimate has settled; "" before that."""
        worst, least = "", 1.0 - self._margin
        for channel in CHANNELS:
            name = f"effectiveness_{channel}_est"
            if abs(row[name] - before[name]) < SETTLED_CHANGE and row[name] < least:
                worst, least = channel.replace("_", " "), float(row[name])
        return f"fault isolated: {worst} {least:.2f}" if worst else ""

    def _limit_events(self, rows: npt.NDArray[Any], first: int) -> Iterator[Event]:
        """Limits that are come near to, or broken."""
        limits = self._limits
        bounded = [name for name in type(limits).model_fields if getattr(limits, name)]
        if not bounded or not rows.size:
            return
        variables = limited_variables(rows)
        for name in bounded:
            low, high = getattr(limits, name)
            margin = np.minimum(variables[name] - low, high - variables[name])
            level = np.where(margin < 0.0, 2, np.where(margin < NEAR_LIMIT * (high - low), 1, 0))
            level = np.where(np.isfinite(margin), level, 0)
            before = np.concatenate(([self._limit_levels.get(name, 0)], level[:-1]))
            self._limit_levels[name] = int(level[-1])
            for k in np.flatnonzero(level > before):
                word, severity = ("broken", CRITICAL) if level[k] == 2 else ("near", WARNING)
                value = f"{variables[name][k]:.4g}"
                yield Event(
                    first + int(k), severity, f"limit {word}: {name} {value}"[:LONGEST_TEXT]
                )
