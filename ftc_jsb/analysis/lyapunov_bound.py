"""V(t) of (37) and the ball of (40) along a flight, where the proof is about it."""

from typing import Any

import numpy as np

from ftc_jsb.recording.flight import Flight
from ftc_jsb.theory.gains import given_gains
from ftc_jsb.theory.lyapunov import LyapunovBound, lyapunov_bound
from ftc_jsb.vocabulary.channels import TRACKED

TRACK_VELOCITY = ("ftc", "no-ftc", "oracle", "ekf")  # whose error obeys e' = (A - B K) e + B d
FEWEST = 3  # samples: rates are central differences
ERROR_SCALE = np.array(
    [1.0, np.radians(1.0), np.radians(1.0)]
)  # 1 m/s, 1 deg, 1 deg: (40) adds them


def proof_along(flight: Flight) -> LyapunovBound | None:
    """The proof's quantities; None for a loop that the proof is not about, or a flight too short."""
    loop = flight.scenario.loop
    if loop.name not in TRACK_VELOCITY or min(loop.gains) <= 0.0 or flight.record.size < FEWEST:
        return None
    return flight_stability(flight)


def flight_stability(flight: Flight, young: float = 0.5) -> LyapunovBound:
    """V(t), lambda, phi and the ball of (40) along a flight of a loop that tracks velocity.

    The errors are scaled by 1 m/s and 1 deg. What the law did not count on, P x~ and O(.) of the
    proof but also the hold of a sample, the inner loop's lag and limits, is d = y' - y_m' + K e with
    y' by central differences of the true state, so that nothing is left out of the bound.

    Args:
        flight: with the gains of its scenario.
        young: mu_1 as a part of its upper limit.
    """
    record = flight.record
    time = record["time"]
    error = np.stack([record[name] - record[f"{name}_ref"] for name in TRACKED], axis=1)
    rate = np.stack([np.gradient(record[name], time) for name in TRACKED], axis=1)
    wanted = np.stack([record[f"{name}_ref_rate"] for name in TRACKED], axis=1)
    k = np.diag(flight.scenario.loop.gains)
    residual = (rate - wanted) / ERROR_SCALE + error / ERROR_SCALE @ k.T
    gains = given_gains(np.zeros((3, 3)), np.eye(3), k)
    return lyapunov_bound(time, error / ERROR_SCALE, residual, np.eye(3), gains, young)


def stability_metrics(proof: LyapunovBound | None) -> dict[str, Any] | None:
    """lambda, phi, the ball and the largest error, scaled by 1 m/s and 1 deg."""
    if proof is None:
        return None
    return {
        "decay_rate_per_s": proof.rate,
        "disturbance": proof.disturbance,
        "ball_radius": proof.radius,
        "largest_error": float(proof.error.max()),
        "bound_obeyed": proof.obeyed,
    }
