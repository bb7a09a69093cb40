"""The verdict on a flight: the worst that is true of it, and what else a reader must know beside it."""

from typing import Any

from ftc_jsb.vocabulary.channels import CHANNELS

Metrics = dict[str, Any]

INSIDE, BROKEN, LOST = "inside limits", "limits broken", "loss of control"
DEPARTED, FAILED, INTERRUPTED = "departed", "failed", "interrupted"
VERDICTS = (INSIDE, BROKEN, LOST, DEPARTED, FAILED, INTERRUPTED)  # better ones first

WRONG_ESTIMATE = 0.1  # of the effectiveness, 95 % of the settled samples: a wrong estimate
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


def reservations(metrics: Metrics) -> list[str]:
    """What a reader must know beside the verdict, in a few words each: an estimate that is wrong, blind, ..."""
    found = []
    error = metrics["effectiveness_thrust_error_p95"]
    if error is not None and error > WRONG_ESTIMATE:
        found.append(f"estimate wrong by {error:.2f}")
    alarms = metrics["false_alarms"]
    if alarms:
        found.append(f"{alarms} false alarm{'s' if alarms > 1 else ''}")
    for channel in CHANNELS:
        part = metrics["unobservable_fraction"].get(channel)
        if part is not None and part > NOTABLE:
            found.append(
                f"{channel.replace('_', ' ')} estimated blind {100.0 * part:.0f} % of the time"
            )
    outside = metrics["outside_identified_fraction"]
    if outside is not None and outside > NOTABLE:
        found.append(f"outside the fitted range {100.0 * outside:.0f} % of the time")
    return found
