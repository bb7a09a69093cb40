"""How a flight ended, in a few words and a time."""

from typing import Any, NamedTuple

from ftc_jsb.analysis.metrics import Metrics
from ftc_jsb.analysis.verdict import LOST, passed, reservations
from ftc_jsb.report.titles import limit_title


class Verdict(NamedTuple):
    """Words, and where in the flight's metrics the time [s] stands that belongs to them."""

    words: str
    time_at: tuple[str | int, ...] | None  # None: no time belongs to it


def verdict(metrics: Metrics) -> Verdict:
    """How a flight ended: early, inside its limits, or which limit it broke first."""
    if metrics["status"] != "complete":
        return Verdict(metrics["status"], ("end_time_s",))
    if metrics["verdict"] == LOST:
        return Verdict(f"{LOST}: {metrics['loss_of_control']}", ("loss_of_control_time_s",))
    if passed(metrics):
        return Verdict("inside limits", None)
    name = limit_title(metrics["limits_broken"][0]["name"])
    return Verdict(f"limit broken: {name}", ("limits_broken", 0, "time"))


def verdict_text(metrics: Metrics) -> str:
    """The verdict with its time to a tenth of a second, and what else is to be said of the flight."""
    words, time_at = verdict(metrics)
    if time_at is not None:
        time: Any = metrics
        for key in time_at:
            time = time[key]
        words = f"{words} at {time:.1f} s"
    return "; ".join([words, *(said.text(metrics) for said in reservations(metrics))])
