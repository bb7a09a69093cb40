"""Numbers from flights: what `metrics.json` holds. No plotting, no files."""

from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.default_limits import flight_limits
from ftc_jsb.analysis.fault_steps import fault_steps
from ftc_jsb.analysis.filter_health import estimator_health
from ftc_jsb.analysis.limits import broken_limits, tracking_errors
from ftc_jsb.analysis.loss_of_control import LossOfControl, inverted, loss_of_control
from ftc_jsb.analysis.verdict import verdict_of
from ftc_jsb.loops.built_in import tuned_by_sensors
from ftc_jsb.recording.flight import Flight
from ftc_jsb.vocabulary.channels import Channel

SETTLING = 2.0  # [s] after the start and after a fault step that the estimate is not judged in
IMPACT = 10.0  # [m] above sea level: below, the ground pushes back
HEALTHY = 1.0 - 1e-9  # effectiveness below which there is a fault

Metrics = dict[str, Any]


def flight_metrics(flight: Flight) -> Metrics:
    """Tracking, estimation, detection, effort and limits of one flight; units are in the keys.

    A number that a flight cannot have is None: an estimation error without an estimator, a
    detection delay without a fault.
    """
    lost = loss_of_control(flight.record)
    judged_flight = flight._replace(record=flight.record[: _judged_rows(flight, lost)])
    record = judged_flight.record
    broken = broken_limits(record, flight_limits(flight.scenario))
    return {
        "status": flight.outcome.status,
        "end_time_s": float(flight.outcome.time),
        "reason": flight.outcome.reason,
        "verdict": verdict_of(flight.outcome.status, lost is not None, bool(broken)),
        "loss_of_control_time_s": None if lost is None else lost.time,
        "loss_of_control": None if lost is None else lost.kind,
        "inverted_time_s": float(np.sum(inverted(flight.record)) * flight.row_period),
        **_tracking(record),
        **_estimation(judged_flight),
        **_detection(record),
        "unobservable_fraction": {
            channel: None
            if tuned_by_sensors(flight.scenario.loop)
            else _part(unobservable(judged_flight, channel), record[f"effectiveness_{channel}_std"])
            for channel in flight.scenario.loop.estimator.channels
        },
        **estimator_health(record),
        **_effort(record),
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


def _tracking(record: npt.NDArray[Any]) -> Metrics:
    errors = tracking_errors(record)
    units = {
        "airspeed_mps": "error_airspeed",
        "flight_path_deg": "error_flight_path_deg",
        "heading_deg": "error_heading_deg",
    }
    return {
        **{f"rmse_{key}": _rms(errors[name]) for key, name in units.items()},
        **{f"peak_error_{key}": _peak(errors[name]) for key, name in units.items()},
        "rmse_position_m": _rms(_distance(record)),
        "peak_error_position_m": _peak(_distance(record)),
    }


def _distance(record: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    """Distance [m] from the path that the references make."""
    square = sum(
        (record[axis] - record[f"{axis}_ref"]) ** 2 for axis in ("north", "east", "altitude")
    )
    return np.asarray(np.sqrt(square))


def judged(flight: Flight) -> npt.NDArray[np.bool_]:
    """(rows,): samples at which the effectiveness estimate is judged.

    Not the first 2 s, nor 2 s after a step of the true effectiveness.
    """
    record = flight.record
    time = record["time"]
    use = np.asarray(time >= SETTLING)
    for step in fault_steps(record["effectiveness_thrust"], flight.scenario):
        use &= ~((time >= time[step]) & (time < time[step] + SETTLING))
    return use


def _estimation(flight: Flight) -> Metrics:
    record = flight.record
    error = record["effectiveness_thrust_est"] - record["effectiveness_thrust"]
    error = np.abs(error[judged(flight) & np.isfinite(error)])
    name = "effectiveness_thrust_error"
    if error.size == 0:
        return {f"{name}_rms": None, f"{name}_p95": None, f"{name}_max": None}
    return {
        f"{name}_rms": _rms(error),
        f"{name}_p95": float(np.percentile(error, 95.0)),
        f"{name}_max": _peak(error),
    }


def unobservable(flight: Flight, channel: Channel) -> npt.NDArray[np.bool_]:
    """(rows,): samples at which the measurements tell nothing of a channel's effectiveness.

    Without information the variance grows by the channel's Q at every step. A channel counts as not
    observable where its variance has grown by more than half of that over the last half second.
    With covariances by the sensors the Q of the flight is not recorded, and nothing is told: no sample.
    """
    estimator, record = flight.scenario.loop.estimator, flight.record
    if tuned_by_sensors(flight.scenario.loop):
        return np.zeros(record.size, dtype=bool)
    variance = record[f"effectiveness_{channel}_std"] ** 2
    noise = estimator.process_noise[3 + estimator.channels.index(channel)]
    if record.size < 2:
        return np.zeros(record.size, dtype=bool)
    row = float(record["time"][1] - record["time"][0])  # [s]; a saved recording may be thinner
    steps = max(round(0.5 / row), 1)
    noise *= round(row * flight.scenario.loop.rate)
    result = np.zeros(record.size, dtype=bool)
    if record.size > steps:
        result[steps:] = variance[steps:] - variance[:-steps] > 0.5 * steps * noise
    return result


def _detection(record: npt.NDArray[Any]) -> Metrics:
    time, truth = record["time"], record["effectiveness_thrust"]
    declared = record["fault_declared"] > 0.5
    faulty = np.flatnonzero(truth < HEALTHY)
    estimates = bool(np.isfinite(record["effectiveness_thrust_est"]).any())
    onsets = np.flatnonzero(np.diff(declared.astype(int), prepend=0) == 1)
    delay = None
    if faulty.size and estimates:
        after = onsets[onsets >= faulty[0]]
        delay = float(time[after[0]] - time[faulty[0]]) if after.size else None
    # Faulty now, or less than SETTLING ago; a truth that is not known is not healthy
    recently = ~(truth >= HEALTHY)
    for end in np.flatnonzero(np.diff(recently.astype(int)) == -1) + 1:
        recently |= (time >= time[end]) & (time < time[end] + SETTLING)
    return {
        "detection_delay_s": delay,
        "false_alarms": int(np.sum(~recently[onsets])) if estimates else None,
    }


def _effort(record: npt.NDArray[Any]) -> Metrics:
    saturated = (record["thrust_saturated"] > 0.5) | (record["load_factor_saturated"] > 0.5)
    duration = record["time"][-1] - record["time"][0]
    part_saturated = _part(saturated, record["thrust_saturated"])
    return {
        "saturated_fraction": part_saturated,
        "saturated_time_s": None if part_saturated is None else part_saturated * float(duration),
        "outside_identified_fraction": _part(
            record["outside_range"] > 0.5, record["outside_range"]
        ),
        "peak_climb_given_up_deg": _peak(np.degrees(record["climb_given_up"])),
        "peak_turn_given_up_deg_s": _peak(np.degrees(record["turn_given_up"])),
        "thrust_travel_n_per_s": _travel(record["thrust_cmd"], duration),
        "load_factor_travel_per_s": _travel(record["load_factor_cmd"], duration),
        "bank_travel_deg_per_s": _travel(np.degrees(record["bank_angle_cmd"]), duration),
        "peak_thrust_n": _peak(record["thrust"]),
        "peak_load_factor": _peak(record["load_factor"]),
        "peak_bank_deg": _peak(np.degrees(record["bank_angle"])),
        "peak_alpha_deg": _peak(np.degrees(record["alpha"])),
        "peak_sideslip_deg": _peak(np.degrees(record["sideslip"])),
    }


def _travel(command: npt.NDArray[Any], duration: float) -> float:
    """Mean absolute rate of a command: the way it goes, up and down, over the flight's time [s]."""
    return float(np.nansum(np.abs(np.diff(command))) / duration) if duration > 0.0 else 0.0


def _part(where: npt.NDArray[np.bool_], known: npt.NDArray[np.float64]) -> float | None:
    """Part of the samples at which something holds, of those at which it is known at all."""
    told = np.isfinite(known)
    return float(np.mean(where[told])) if told.any() else None


def _rms(values: npt.NDArray[Any]) -> float | None:
    finite = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(finite**2))) if finite.size else None


def _peak(values: npt.NDArray[Any]) -> float | None:
    finite = values[np.isfinite(values)]
    return float(np.abs(finite).max()) if finite.size else None
