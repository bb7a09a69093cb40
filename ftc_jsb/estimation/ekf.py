"""Extended Kalman filter: the prediction that linearises where the UKF samples.

The Jacobian of the discrete map is taken by central differences of the same `propagate`, so that
the equations of motion are not written a second time.
"""

from ftc_jsb.compiled import compiled, inlined
from ftc_jsb.estimation.process import Forcing, axes, propagate
from ftc_jsb.point_mass.model import Condition
from ftc_jsb.vocabulary.kernel_types import Filter, Vector

RELATIVE_STEP = 1e-6  # of the state, or of 1: error of the Jacobian near 1e-9


@inlined
def _difference(value: float) -> float:
    """Half the distance over which the Jacobian is taken, of a state near `value`."""
    return RELATIVE_STEP * max(1.0, abs(value))


@compiled
def predict_extended(
    filter_state: Filter, at: Condition, forcing: Forcing, process_noise: Vector, dt: float
) -> None:
    """X = f(x, u), P = Phi P Phi^T + Q, in place; arguments as `ukf.predict_unscented`."""
    n = filter_state.count
    estimate = filter_state.estimate
    covariance = filter_state.covariance
    jacobian = filter_state.factor
    points = filter_state.points
    for i in range(n):
        for k in range(2 * n + 1):
            points[k, i] = estimate[i]
    for j in range(n):
        step = _difference(estimate[j])
        points[1 + j, j] += step
        points[1 + n + j, j] -= step
    propagate(at, forcing, axes(forcing, estimate[1]), filter_state, 2 * n + 1, dt)
    for j in range(n):
        step = _difference(estimate[j])
        for i in range(n):
            jacobian[i, j] = (points[1 + j, i] - points[1 + n + j, i]) / (2.0 * step)
    for i in range(n):
        estimate[i] = points[0, i]
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
