"""Numbers from one flight: its entry in `metrics.json`. No plotting, no files."""

from typing import Any

import numpy as np

from ftc_jsb.analysis.control_effort import effort_metrics
from ftc_jsb.analysis.default_limits import flight_limits
from ftc_jsb.analysis.effectiveness_estimate import estimate_metrics, unobservable_fractions
from ftc_jsb.analysis.fault_detection import detection_metrics
from ftc_jsb.analysis.filter_health import estimator_health
from ftc_jsb.analysis.isolation import isolation_metrics
from ftc_jsb.analysis.limits import broken_limits
from ftc_jsb.analysis.loss_of_control import LossOfControl, inverted, loss_of_control
from ftc_jsb.analysis.tracking import tracking_metrics
from ftc_jsb.analysis.verdict import verdict_of
from ftc_jsb.recording.flight import Flight

IMPACT = 10.0  # [m] above sea level: below, the ground pushes back
Metrics = dict[str, Any]


def flight_metrics(flight: Flight) -> Metrics:
    """Tracking, estimation, detection, effort and limits of one flight; units are in the keys.

    A number that a flight cannot have is None: an estimation error without an estimator, a
    detection delay without a fault.
    """
    lost = loss_of_control(flight.record)
    judged = flight._replace(record=flight.record[: _judged_rows(flight, lost)])
    record = judged.record
    broken = broken_limits(record, flight_limits(flight.scenario))
    return {
        "status": flight.outcome.status,
        "end_time_s": float(flight.outcome.time),
        "reason": flight.outcome.reason,
        "verdict": verdict_of(flight.outcome.status, lost is not None, bool(broken)),
        "loss_of_control_time_s": None if lost is None else lost.time,
        "loss_of_control": None if lost is None else lost.kind,
        "inverted_time_s": float(np.sum(inverted(flight.record)) * flight.row_period),
        **tracking_metrics(record),
        **estimate_metrics(judged),
        **detection_metrics(record),
        **isolation_metrics(judged),
        "unobservable_fraction": unobservable_fractions(judged),
        **estimator_health(record),
        **effort_metrics(record),
        "real_time_factor": flight.real_time_factor,
        "limits_broken": [limit._asdict() for limit in broken],
    }


def _judged_rows(flight: Flight, lost: LossOfControl | None) -> int:
    """Rows that tracking, peaks and limits are of: up to the loss of control, or to the ground."""
    record = flight.record
    rows = record.size
    if lost is not None:
        rows = int(np.searchsorted(record["time"], lost.time))
    elif flight.outcome.status == "departed":
        low = np.flatnonzero(record["altitude"] < IMPACT)
        rows = int(low[0]) if low.size else rows
    return max(rows, 1)
