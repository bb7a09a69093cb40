"""The proof's prediction accepts the flights of the paper and rejects what is no such flight."""

import numpy as np
import pytest

from ftc_jsb.analysis.lyapunov_bound import ERROR_SCALE, flight_stability, proof_along

LOOPS = ["ftc", "ekf", "oracle", "no-ftc"]


@pytest.mark.parametrize("loop", LOOPS)
def test_flights_of_the_paper_obey(flown, loop):
    """Every assumption holds, and V stays below what was predicted without the flight."""
    proof = proof_along(flown("paper", f"loop.name={loop}"))
    assert proof.broken == ()
    assert proof.obeyed
    assert proof.rate == pytest.approx(
        1.0
    )  # K = I, Q = I: lambda_min(Q) / lambda_max(H) = 2, halved
    assert proof.error.max() <= proof.predicted.max() <= proof.radius


def test_predicted_error_is_within_a_factor_of_five(flown):
    """Largest error predicted against the largest flown; the ball (40) takes the worst instant of phi
    for a state that lasts, and is farther.
    """
    proof = flight_stability(flown("paper"))
    assert proof.predicted.max() < 5.0 * proof.error.max()


def _random_walk(time):
    return np.cumsum(np.random.default_rng(0).standard_normal(time.size)) * 0.1


SIGNALS = {
    "random walk": _random_walk,
    "diverging exponential": lambda time: 1e-3 * np.exp(0.3 * time),
    "limit cycle": lambda time: 100.0 * np.sin(2.0 * time),
    "offset": lambda time: 5.0 * (time > 1.0),
}


@pytest.mark.parametrize("name", SIGNALS)
def test_signals_that_no_such_loop_makes_are_rejected(flown, name):
    """Added to the airspeed [m/s] of the paper's flight, each exceeds the bound of V."""
    flight = flown("paper")
    record = flight.record.copy()
    record["airspeed"] += SIGNALS[name](record["time"])
    proof = flight_stability(flight._replace(record=record))
    assert not proof.below
    assert not proof.obeyed


def test_fault_that_was_not_declared_is_rejected(flown):
    """The flight with a loss to 0.6 against the prediction for none: x~ is larger than assumed, and V
    exceeds its bound.
    """
    flight = flown("paper")
    undeclared = flight.scenario.model_copy(update={"fault": ()})
    proof = flight_stability(flight._replace(scenario=undeclared))
    assert not proof.below
    assert any("the estimate errs by more than assumed at 20.0" in words for words in proof.broken)


def test_destabilised_loop_is_rejected(flown):
    """At 2 Hz and K = 5 the sampled loop diverges, 1 - K dt = -1.5: the proof has no bound for it."""
    flight = flown("paper", "loop.gains=[5, 5, 5]", "loop.rate=2", "duration=6")
    proof = flight_stability(flight)
    assert not proof.obeyed
    assert "a command is held too long for the gains" in proof.broken


def test_proof_is_about_the_model_that_the_law_has(flown):
    assert proof_along(flown("paper", "model=identified")) is None
    assert ERROR_SCALE[0] == 1.0
