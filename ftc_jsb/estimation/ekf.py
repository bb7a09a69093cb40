"""Extended Kalman filter: the prediction that linearises where the UKF samples.

The Jacobian of the discrete map is taken by central differences of the same `propagate`, so that
the equations of motion are not written a second time.
"""

from typing import Any

from ftc_jsb.compiled import compiled
from ftc_jsb.estimation.process import Forcing, propagate
from ftc_jsb.point_mass.model import Condition

RELATIVE_STEP = 1e-6  # of the state, or of 1: error of the Jacobian near 1e-9


@compiled
def predict_extended(
    filter_state: Any, at: Condition, forcing: Forcing, process_noise: Any, dt: float
) -> None:
    """X = f(x, u), P = Phi P Phi^T + Q, in place; arguments as `ukf.predict_unscented`."""
    n = filter_state.count
    estimate = filter_state.estimate
    covariance = filter_state.covariance
    jacobian = filter_state.factor
    points = filter_state.points
    for j in range(n):
        step = RELATIVE_STEP * max(1.0, abs(estimate[j]))
        for i in range(n):
            points[1, i] = estimate[i]
            points[2, i] = estimate[i]
        points[1, j] += step
        points[2, j] -= step
        propagate(at, forcing, filter_state, points[1], dt)
        propagate(at, forcing, filter_state, points[2], dt)
        for i in range(n):
            jacobian[i, j] = (points[1, i] - points[2, i]) / (2.0 * step)
    propagate(at, forcing, filter_state, estimate, dt)
    product = points  # scratch for Phi P
    for i in range(n):
        for j in range(n):
            total = 0.0
            for k in range(n):
                total += jacobian[i, k] * covariance[k, j]
            product[i, j] = total
    for i in range(n):
        for j in range(i + 1):
            total = 0.0
            for k in range(n):
                total += product[i, k] * jacobian[j, k]
            covariance[i, j] = total
            covariance[j, i] = total
        covariance[i, i] += process_noise[i]
