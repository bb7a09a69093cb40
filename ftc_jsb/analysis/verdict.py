"""The verdict on a flight: the worst that is true of it, and what else a reader must know beside it."""

from typing import Any, NamedTuple

Metrics = dict[str, Any]

INSIDE, BROKEN, LOST = "inside limits", "limits broken", "loss of control"
DEPARTED, FAILED, INTERRUPTED = "departed", "failed", "interrupted"
VERDICTS = (INSIDE, BROKEN, LOST, DEPARTED, FAILED, INTERRUPTED)  # better ones first

WRONG_ESTIMATE = 0.1  # of the effectiveness, 95 % of the settled samples: a wrong estimate
SLOWER = 1.0  # [m/s] of airspeed given up from which on it is said
NOTABLE = 0.05  # part of the time from which on being blind or outside the fit is said


def verdict_of(status: str, lost: bool, broken: bool) -> str:
    """The verdict of a flight's outcome.

    Args:
        status: of `recording.flight.Outcome`.
        lost: control was lost.
        broken: a limit was broken.
    """
    if status in (DEPARTED, FAILED, INTERRUPTED):
        return status
    if lost:
        return LOST
    return BROKEN if broken else INSIDE


def passed(metrics: Metrics) -> bool:
    """Whether a flight ended as planned, in control, inside every limit."""
    return bool(metrics["verdict"] == INSIDE)


class Reservation(NamedTuple):
    """A number that a reader must know beside the verdict, and the words around it."""

    before: str
    place: tuple[str, ...]  # of the number, in the metrics
    factor: float
    digits: int
    after: str

    def text(self, metrics: Metrics) -> str:
        """The words with the number."""
        value: Any = metrics
        for key in self.place:
            value = value[key]
        return f"{self.before}{self.factor * value:.{self.digits}f}{self.after}"


def reservations(metrics: Metrics) -> list[Reservation]:
    """An estimate that is wrong, false alarms, an estimate flown blind, a flight outside the fitted range."""
    found = []
    error = metrics["effectiveness_thrust_error_p95"]
    if error is not None and error > WRONG_ESTIMATE:
        place: tuple[str, ...] = ("effectiveness_thrust_error_p95",)
        found.append(Reservation("estimate wrong by ", place, 1.0, 2, ""))
    if metrics["false_alarms"]:
        found.append(Reservation("false alarms: ", ("false_alarms",), 1.0, 0, ""))
    if metrics["false_suspicions"]:
        found.append(Reservation("wrongly suspected: ", ("false_suspicions",), 1.0, 0, ""))
    percent = 100.0
    for channel, part in metrics["unobservable_fraction"].items():
        if part is not None and part > NOTABLE:
            name = channel.replace("_", " ")
            place = ("unobservable_fraction", channel)
            found.append(
                Reservation(f"{name} estimated blind ", place, percent, 0, " % of the time")
            )
    short = metrics["unattainable_fraction"]
    if short is not None and short > NOTABLE:
        place = ("unattainable_fraction",)
        found.append(Reservation("references not attainable ", place, percent, 0, " % of the time"))
    slower = metrics["peak_airspeed_given_up_mps"]
    if slower is not None and slower > SLOWER:
        place = ("peak_airspeed_given_up_mps",)
        found.append(Reservation("glides up to ", place, 1.0, 0, " m/s below its reference"))
    outside = metrics["outside_identified_fraction"]
    if outside is not None and outside > NOTABLE:
        place = ("outside_identified_fraction",)
        found.append(Reservation("outside the fitted range ", place, percent, 0, " % of the time"))
    return found
