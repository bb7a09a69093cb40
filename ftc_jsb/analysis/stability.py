"""V(t) of (37) and the ball of (40) along a flight, where the theory gives them."""

from typing import Any

from ftc_jsb.recording.flight import Flight
from ftc_jsb.theory.lyapunov import LyapunovBound

TRACK_VELOCITY = ("ftc", "no-ftc", "oracle", "ekf")  # whose error obeys e' = (A - B K) e + B d
FEWEST = 3  # samples: rates are central differences


def flight_theory(flight: Flight) -> LyapunovBound | None:
    """The proof's quantities; None for a loop that the proof is not about, or a flight too short."""
    gains = flight.scenario.loop.gains
    if flight.scenario.loop.name not in TRACK_VELOCITY or min(gains) <= 0.0:
        return None
    record = flight.record
    if record.size < FEWEST:
        return None
    from ftc_jsb.analysis.along_flight import flight_stability

    return flight_stability(flight)


def stability_metrics(theory: LyapunovBound | None) -> dict[str, Any] | None:
    """lambda, phi, the ball and the largest error, scaled by 1 m/s and 1 deg."""
    if theory is None:
        return None
    return {
        "decay_rate_per_s": theory.rate,
        "disturbance": theory.disturbance,
        "ball_radius": theory.radius,
        "largest_error": float(theory.error.max()),
        "bound_obeyed": theory.obeyed,
    }
