"""The robustness margin of a verdict: signed distance to the nearest limit over a flight, normalised."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.default_limits import flight_limits
from ftc_jsb.analysis.limits import limited_variables
from ftc_jsb.analysis.metrics import Metrics
from ftc_jsb.analysis.verdict import BROKEN, INSIDE, WRONG_ESTIMATE
from ftc_jsb.recording.flight import Flight
from ftc_jsb.scenario.limits import Limits

LOST = "control"  # what is nearest where control was lost or the flight ended


class Margin(NamedTuple):
    """How far a flight stayed from the nearest limit: 1 in the middle of its range, 0 at it, below 0 beyond."""

    value: float
    limit: str  # key of [limits], or LOST
    time: float  # [s]


def robustness_margin(flight: Flight, metrics: Metrics) -> Margin:
    """The margin; at least 0 for the verdict `inside limits`, and below for every other.

    Robust semantics of "always inside every limit" (Fainekos and Pappas 2009), each limit [low, high]
    scaled by half its width; not beyond -1. A flight that lost control, departed or failed has -1 and up
    to 1 less, the earlier it ended.

    Args:
        flight: complete recording.
        metrics: of `flight_metrics`.
    """
    nearest = nearest_limit(flight.record, flight_limits(flight.scenario))
    if metrics["verdict"] == INSIDE:
        return nearest._replace(value=max(nearest.value, 0.0))
    if metrics["verdict"] == BROKEN:
        return nearest._replace(value=min(max(nearest.value, -1.0), -1e-9))
    lost = metrics["loss_of_control_time_s"]
    time = float(metrics["end_time_s"] if lost is None else lost)
    return Margin(-2.0 + min(time / flight.scenario.duration, 1.0), LOST, time)


def estimate_margin(metrics: Metrics) -> float | None:
    """How far the thrust effectiveness estimate is from wrong: 1 exact, 0 at the bound, below 0 beyond."""
    error = metrics["effectiveness_thrust_error_p95"]
    return None if error is None else 1.0 - float(error) / WRONG_ESTIMATE


def nearest_limit(record: npt.NDArray[Any], limits: Limits) -> Margin:
    """The limit that a recording comes nearest to, or goes farthest beyond; what is not recorded has none."""
    variables = limited_variables(record)
    nearest = Margin(1.0, "", 0.0)
    for name in type(limits).model_fields:
        bounds = getattr(limits, name)
        if bounds is None:
            continue
        low, high = bounds
        distance = np.minimum(variables[name] - low, high - variables[name]) / (0.5 * (high - low))
        least = float(np.fmin.reduce(distance))  # nan, and so never less, where nothing is recorded
        if least < nearest.value and np.isfinite(variables[name]).any():
            row = int(np.argmax(distance == least))
            nearest = Margin(least, name, float(record["time"][row]))
    return nearest
