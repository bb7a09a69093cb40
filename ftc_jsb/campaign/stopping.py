"""When a campaign has flown enough: looks at its first cases, always the same ones, whoever flew them."""

from collections import defaultdict
from collections.abc import Iterable
from typing import Any

from ftc_jsb.analysis.verdict import DEPARTED, INSIDE, LOST
from ftc_jsb.campaign.schema import Event, Stop
from ftc_jsb.campaign.statistics import rate, wilson

Row = dict[str, Any]
COLUMNS = [  # of a row, that an event is told by
    "case", "model", "loop", "verdict", "end_time_s", "false_alarms", "detection_delay_s", "fault_s",
]  # fmt: skip
SECONDS = 3600.0  # of an hour


def events_of(event: Event, row: Row) -> int | None:
    """How often a flight has an event; None where it cannot have it, or was not flown."""
    verdict = row.get("verdict")
    if verdict is None:
        return None
    if event == "failure":
        return int(verdict != INSIDE)
    if event == "loss-of-control":
        return int(verdict in (LOST, DEPARTED))
    alarms = row.get("false_alarms")
    if alarms is None:  # without an estimator
        return None
    if event == "false-alarm":
        return int(alarms)
    if not row.get("fault_s"):
        return None
    return int(row.get("detection_delay_s") is None)


class Looks:
    """Cases as they come in, looked at in their own order every so many of them."""

    def __init__(self, rule: Stop | None) -> None:
        """Args: None never stops."""
        self._rule = rule
        self._waiting: dict[int, list[Row]] = defaultdict(list)
        self._counts: dict[tuple[Any, Any], list[float]] = defaultdict(lambda: [0, 0, 0, 0.0])
        self._next = 0
        self._end: int | None = None

    @property
    def end(self) -> int | None:
        """Cases after which the campaign is over; None as long as it is not."""
        return self._end

    def add(self, rows: Iterable[Row]) -> None:
        """Take whole cases, in any order."""
        if self._rule is None:
            return
        for row in rows:
            self._waiting[row["case"]].append(row)
        while self._end is None and self._next in self._waiting:
            for row in self._waiting.pop(self._next):
                self._count(row, self._rule)
            self._next += 1
            if self._next % self._rule.every == 0 and self._enough(self._rule):
                self._end = self._next

    def _count(self, row: Row, rule: Stop) -> None:
        found = events_of(rule.event, row)
        if found is not None:
            counts = self._counts[row["model"], row["loop"]]
            counts[0] += 1
            counts[1] += min(found, 1)
            counts[2] += found
            counts[3] += (row.get("end_time_s") or 0.0) / SECONDS

    def _enough(self, rule: Stop) -> bool:
        """Whether the rules are met for every model and loop."""
        if not self._counts:
            return False
        for cases, having, events, hours in self._counts.values():
            if rule.interval_width is not None:
                interval = wilson(int(having), int(cases), rule.confidence)
                if interval.high - interval.low > rule.interval_width:
                    return False
            if rule.rate_per_hour is not None:
                bounds = rate(int(events), hours, rule.confidence)
                if bounds.low <= rule.rate_per_hour < bounds.high:  # neither proven nor refuted
                    return False
        return True
