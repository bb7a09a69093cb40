"""Measurement update (31)-(34) for y = [airspeed, flight path angle, heading], with gate and bounds.

The outputs are the first three states, so (31)-(33) are exact without sigma points:
P_yy = H P H^T + R and P_xy = P H^T. The covariance of (34), P - K P_yy K^T, is formed as
(I - K H) P (I - K H)^T + K R K^T, which is the same matrix for this K and stays positive definite
under rounding (Bucy and Joseph 1968).
"""

import math

from ftc_jsb.compiled import compiled, inlined
from ftc_jsb.estimation.cholesky import cholesky, cholesky_solve
from ftc_jsb.estimation.process import OUTPUTS
from ftc_jsb.vocabulary.kernel_types import Filter, Vector


@compiled
def update(
    filter_state: Filter,
    measurement: Vector,
    measurement_noise: Vector,
    gate: float,
    gate_patience: int,
    floor: float,
) -> None:
    """Correct `filter_state` in place by one measurement.

    Where an element is not finite the others are corrected by, one after the other: a silent instrument
    costs itself alone. With a gate, a measurement whose normalised innovation squared exceeds it is skipped,
    but not more than `gate_patience` times in a row: an outlier passes by, and a real jump is followed.

    Args:
        filter_state: FILTER record.
        measurement: (3,) airspeed [m/s], flight path angle and heading [rad].
        measurement_noise: (3,), diagonal of R.
        gate: bound on the normalised innovation squared; 0 = no gate.
        gate_patience: samples in a row that may be refused.
        floor: lower bound of the effectiveness estimates, whose upper bound is then 1; 0 = neither.
    """
    finite = _innovate(filter_state, measurement, measurement_noise)
    if not finite:
        for k in range(OUTPUTS):
            if math.isfinite(measurement[k]):
                innovation = measurement[k] - filter_state.estimate[k]
                update_by_state(filter_state, k, 1.0, innovation, measurement_noise[k], floor)
        return
    if not _passes_gate(filter_state, gate, gate_patience):
        return
    _correct(filter_state, measurement_noise)
    _bound(filter_state, floor)


@inlined
def _innovate(filter_state: Filter, measurement: Vector, measurement_noise: Vector) -> bool:
    """Innovation y - y^ of (32), P_yy of (33), its factor, and the normalised innovation squared.

    Returns:
        Whether every element of the innovation is finite.
    """
    factor = filter_state.factor
    innovation = filter_state.innovation
    spread = filter_state.innovation_covariance
    finite = True
    for i in range(OUTPUTS):
        innovation[i] = measurement[i] - filter_state.estimate[i]
        finite = finite and math.isfinite(innovation[i])
        for j in range(OUTPUTS):
            spread[i, j] = filter_state.covariance[i, j]
        spread[i, i] += measurement_noise[i]
    cholesky(spread, OUTPUTS, factor)
    whitened = filter_state.points[0]
    for i in range(OUTPUTS):
        whitened[i] = innovation[i]
    cholesky_solve(factor, OUTPUTS, whitened)
    filter_state.nis = 0.0
    for i in range(OUTPUTS):
        filter_state.nis += innovation[i] * whitened[i]
    return finite


@inlined
def _passes_gate(filter_state: Filter, gate: float, gate_patience: int) -> bool:
    """Whether the innovation is to be corrected by; counts refusals in a row."""
    if gate > 0.0 and filter_state.nis > gate and filter_state.rejected < gate_patience:
        filter_state.rejected += 1
        return False
    filter_state.rejected = 0
    return True


@inlined
def _correct(filter_state: Filter, measurement_noise: Vector) -> None:
    """(34), the covariance in Joseph's form; the factor of P_yy is that of `_innovate`."""
    n = filter_state.count
    estimate = filter_state.estimate
    covariance = filter_state.covariance
    gain = filter_state.gain
    for i in range(n):  # K = P_xy P_yy^-1, row by row
        for j in range(OUTPUTS):
            gain[i, j] = covariance[i, j]
        cholesky_solve(filter_state.factor, OUTPUTS, gain[i])
    for i in range(n):
        for j in range(OUTPUTS):
            estimate[i] += gain[i, j] * filter_state.innovation[j]
    product = filter_state.points  # (I - K H) P
    for i in range(n):
        for j in range(n):
            total = covariance[i, j]
            for k in range(OUTPUTS):
                total -= gain[i, k] * covariance[k, j]
            product[i, j] = total
    for i in range(n):
        for j in range(i + 1):
            total = product[i, j]
            for k in range(OUTPUTS):
                total -= product[i, k] * gain[j, k]
                total += gain[i, k] * measurement_noise[k] * gain[j, k]
            covariance[i, j] = total
            covariance[j, i] = total


@inlined
def _bound(filter_state: Filter, floor: float) -> None:
    """Keep the effectiveness estimates in [floor, 1]; 0 = not at all."""
    if floor > 0.0:
        for i in range(OUTPUTS, filter_state.count):
            filter_state.estimate[i] = min(max(filter_state.estimate[i], floor), 1.0)


@compiled
def update_by_state(
    filter_state: Filter, place: int, slope: float, innovation: float, noise: float, floor: float
) -> float:
    """Correct by one number that depends on one state only: y = slope x_place + const + noise.

    Args:
        filter_state: FILTER record.
        place: of the state, an effectiveness.
        slope: dy/dx.
        innovation: measured less predicted y.
        noise: variance of y.
        floor: as `update` takes it.

    Returns:
        Standard deviation of the innovation.
    """
    n = filter_state.count
    estimate = filter_state.estimate
    covariance = filter_state.covariance
    column = filter_state.points[0]
    gain = filter_state.points[1]
    spread = slope * slope * covariance[place, place] + noise
    for i in range(n):
        column[i] = slope * covariance[i, place]
        gain[i] = column[i] / spread
    for i in range(n):
        estimate[i] += gain[i] * innovation
        for j in range(i + 1):  # P - K S K^T in Joseph's form, (I - K h) P (I - K h)^T + K R K^T
            total = covariance[i, j] - gain[i] * column[j] - column[i] * gain[j]
            covariance[i, j] = total + gain[i] * spread * gain[j]
            covariance[j, i] = covariance[i, j]
    _bound(filter_state, floor)
    return math.sqrt(spread)
