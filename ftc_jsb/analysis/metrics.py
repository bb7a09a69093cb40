"""Numbers from one flight: its entry in `metrics.json`. No plotting, no files."""

from typing import Any

from ftc_jsb.analysis.control_effort import effort_metrics
from ftc_jsb.analysis.effectiveness_estimate import estimate_metrics, unobservable_fractions
from ftc_jsb.analysis.fault_detection import detection_metrics
from ftc_jsb.analysis.filter_health import estimator_health
from ftc_jsb.analysis.limits import broken_limits
from ftc_jsb.analysis.tracking import tracking_metrics
from ftc_jsb.recording.flight import Flight

Metrics = dict[str, Any]


def flight_metrics(flight: Flight) -> Metrics:
    """Tracking, estimation, detection, effort and limits of one flight; units are in the keys.

    A number that a flight cannot have is None: an estimation error without an estimator, a
    detection delay without a fault.
    """
    record = flight.record
    return {
        "status": flight.outcome.status,
        "end_time_s": float(flight.outcome.time),
        "reason": flight.outcome.reason,
        **tracking_metrics(record),
        **estimate_metrics(flight),
        **detection_metrics(record),
        "unobservable_fraction": unobservable_fractions(flight),
        **estimator_health(record),
        **effort_metrics(record),
        "real_time_factor": flight.real_time_factor,
        "limits_broken": [
            limit._asdict() for limit in broken_limits(record, flight.scenario.limits)
        ],
    }


def passed(metrics: Metrics) -> bool:
    """Whether a flight ended as planned, inside every limit."""
    return metrics["status"] in ("complete", "ended") and not metrics["limits_broken"]
