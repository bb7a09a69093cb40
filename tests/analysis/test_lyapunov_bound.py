"""The proof's quantities along real flights of the fighter."""

import pytest

from ftc_jsb.analysis.lyapunov_bound import flight_stability


@pytest.mark.parametrize("model", ["paper", "identified", "jsbsim"])
def test_error_obeys_the_bound_of_39_on_every_model(flown, model):
    """V(t) <= exp(-lambda t) V(0) + phi / lambda, with all that the law did not count on in phi."""
    proof = flight_stability(flown("paper", f"model={model}"))
    assert proof.rate == pytest.approx(
        1.0
    )  # K = I, Q = I: lambda_min(Q) / lambda_max(H) = 2, halved
    assert proof.obeyed
    assert proof.error.max() <= proof.radius


def test_ball_is_smaller_with_fault_tolerance(flown):
    """The radius of (40) with the estimate is less than half of that without."""
    with_it = flight_stability(flown("paper"))
    without = flight_stability(flown("paper", "loop.name=no-ftc"))
    settled = with_it.error[2300:].max(), without.error[2300:].max()
    assert settled[0] < 0.2 * settled[1]


def test_bound_can_be_broken(flown):
    """Half of the disturbance left out of phi, and the inequality fails where it must."""
    proof = flight_stability(flown("paper", "loop.name=no-ftc"))
    assert not proof._replace(bound=0.01 * proof.bound).obeyed
