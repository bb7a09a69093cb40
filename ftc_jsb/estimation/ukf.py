"""Unscented Kalman filter (21)-(34) in the reduced form that flies.

With additive noise the paper's augmented filter of dimension n_a = n + n_v + n_xi needs only the
sigma points of the n states: those of the noise have zero mean and enter linearly, so that they
add Q in (30) and R in (33). The spread n_a + kappa, 3 by the advice below (26), stays the same,
and the centre weight becomes W_0 = 1 - n / (n_a + kappa): -1/3 for four states.
"""

from typing import Any

from ftc_jsb.compiled import compiled
from ftc_jsb.estimation.cholesky import cholesky
from ftc_jsb.estimation.process import Forcing, axes, propagate
from ftc_jsb.point_mass.model import Condition


@compiled
def predict_unscented(
    filter_state: Any,
    at: Condition,
    forcing: Forcing,
    process_noise: Any,
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
    factor = filter_state.factor
    points = filter_state.points
    cholesky(covariance, n, factor)
    scale = spread**0.5
    for i in range(n):  # (26)
        points[0, i] = estimate[i]
        for j in range(n):
            offset = scale * factor[i, j]
            points[1 + j, i] = estimate[i] + offset
            points[1 + n + j, i] = estimate[i] - offset
    propagate(at, forcing, axes(forcing, estimate[1]), filter_state, 2 * n + 1, dt)  # (27)
    weight = 0.5 / spread  # (29)
    centre = 1.0 - n / spread
    for i in range(n):  # (28), as a mean of differences: no cancellation with a negative centre
        total = 0.0
        for k in range(1, 2 * n + 1):
            total += points[k, i] - points[0, i]
        estimate[i] = points[0, i] + weight * total
    for i in range(n):  # (30), the noise part of the augmented points being Q
        for j in range(i + 1):
            total = centre * (points[0, i] - estimate[i]) * (points[0, j] - estimate[j])
            for k in range(1, 2 * n + 1):
                total += weight * (points[k, i] - estimate[i]) * (points[k, j] - estimate[j])
            covariance[i, j] = total
            covariance[j, i] = total
        covariance[i, i] += process_noise[i]
