"""Unscented Kalman filter (21)-(34) in the reduced form that flies.

With additive noise the paper's augmented filter of dimension n_a = n + n_v + n_xi needs only the
sigma points of the n states: those of the noise have zero mean and enter linearly, so that they
add Q in (30) and R in (33). The spread n_a + kappa, 3 by the advice below (26), stays the same,
and the centre weight becomes W_0 = 1 - n / (n_a + kappa): -1/3 for four states.
"""

from ftc_jsb.compiled import compiled
from ftc_jsb.estimation.process import Forcing, axes, propagate
from ftc_jsb.estimation.sigma_points import (
    add_noise,
    covariance_of,
    draw_points,
    mean_of,
    weights_of,
)
from ftc_jsb.point_mass.model import Condition
from ftc_jsb.vocabulary.kernel_types import Filter, Vector


@compiled
def predict_unscented(
    filter_state: Filter,
    at: Condition,
    forcing: Forcing,
    process_noise: Vector,
    spread: float,
    dt: float,
) -> None:
    """Prediction (26)-(30): estimate and covariance of `filter_state` go from k-1 to k.

    Args:
        filter_state: FILTER record, changed in place.
        at: the model at the sample's flight condition.
        forcing: what acted over the sample.
        process_noise: (STATES,), diagonal of Q per step.
        spread: n_a + kappa of (26) and (29).
        dt: sample time [s].
    """
    n = filter_state.count
    estimate = filter_state.estimate
    covariance = filter_state.covariance
    points = filter_state.points
    weights = weights_of(n, spread)  # (29)
    draw_points(estimate, covariance, n, spread, filter_state.factor, points)  # (26)
    near = axes(forcing, estimate[1])
    propagate(at, forcing, near, filter_state, weights.points, dt)  # (27)
    mean_of(points, weights, n, estimate)  # (28)
    covariance_of(points, estimate, weights, n, covariance)  # (30)
    add_noise(covariance, process_noise, n)
