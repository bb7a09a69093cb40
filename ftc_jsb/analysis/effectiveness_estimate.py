"""How right the estimate of an effectiveness is, and where the measurements tell nothing of it."""

from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.fault_steps import SETTLING, fault_steps
from ftc_jsb.analysis.finite_statistics import fraction, peak, root_mean_square
from ftc_jsb.control.instruments import LEAST_THRUST
from ftc_jsb.loops.built_in import tuned_by_sensors
from ftc_jsb.recording.flight import Flight
from ftc_jsb.units import STANDARD_GRAVITY
from ftc_jsb.vocabulary.channels import Channel


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


def estimate_metrics(flight: Flight) -> dict[str, float | None]:
    """RMS, 95th percentile and peak of the thrust effectiveness error where it is judged."""
    record = flight.record
    error = record["effectiveness_thrust_est"] - record["effectiveness_thrust"]
    error = np.abs(error[judged(flight) & np.isfinite(error)])
    return {
        "effectiveness_thrust_error_rms": root_mean_square(error),
        "effectiveness_thrust_error_p95": float(np.percentile(error, 95.0)) if error.size else None,
        "effectiveness_thrust_error_max": peak(error),
    }


def unobservable(flight: Flight, channel: Channel) -> npt.NDArray[np.bool_]:
    """(rows,): samples at which the measurements tell nothing of a channel's effectiveness.

    Without information the variance grows by the channel's Q at every step. A channel counts as not
    observable where its variance has grown by more than half of that over the last half second.
    With covariances by the sensors the Q of the flight is not recorded: thrust is not observable there
    where the loop expects less than 2 % of the weight of it.
    """
    estimator, record = flight.scenario.loop.estimator, flight.record
    if tuned_by_sensors(flight.scenario.loop):
        blind = np.abs(record["thrust_model"]) < LEAST_THRUST * STANDARD_GRAVITY * record["mass"]
        return np.asarray(blind & (channel == "thrust"))
    variance = record[f"effectiveness_{channel}_std"] ** 2
    noise = estimator.process_noise[3 + estimator.channels.index(channel)]
    if record.size < 2:
        return np.zeros(record.size, dtype=bool)
    row = flight.row_period  # [s]; a saved recording may be thinner than a sample
    steps = max(round(0.5 / row), 1)  # of half a second
    noise *= round(row * flight.scenario.loop.rate)
    result = np.zeros(record.size, dtype=bool)
    if record.size > steps:
        result[steps:] = variance[steps:] - variance[:-steps] > 0.5 * steps * noise
    return result


def unobservable_fractions(flight: Flight) -> dict[str, Any]:
    """Part of the samples at which each estimated channel is not observable; None without an estimate."""
    loop = flight.scenario.loop
    return {
        channel: fraction(
            unobservable(flight, channel), flight.record[f"effectiveness_{channel}_std"]
        )
        for channel in loop.estimator.channels
    }
