"""How far the joint estimate will be from the truth: the linearised filter along a nominal flight.

The nominal flight is that of section 3, with state and fault known: nothing of the adaptive flight
is in it. Along it the filter's covariance and its response to each step of k follow from (26)-(34)
linearised, and the assumption of the proof that x~ is bounded gets its numbers before the flight.
"""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
RELATIVE_STEP = 1e-6  # of the state, or of 1, for the Jacobians
MARGIN = 1.5  # on the linear response: what the filter's nonlinearity and the other inputs may add
SIGMAS = 4.0  # of the filter's own covariance, where sensors are noisy


class Nominal(NamedTuple):
    """A flight with state and fault known."""

    state: Array  # (rows, states)
    command: Array  # (rows, inputs)


class FilterModel(NamedTuple):
    """What the recursion needs of a filter."""

    propagate: Any  # (plant, x, u, k, p, dt, scratch)
    outputs: Any  # (x, p, out)
    parameters: Array
    fallible: tuple[int, ...]  # inputs whose effectiveness is estimated
    process_noise: Array  # (states + faults,)
    measurement_noise: Array  # (measured,)
    initial_covariance: Array  # (states + faults,)
    dt: float


def error_envelope(
    model: FilterModel, nominals: list[Nominal], effectiveness: Array, floor: Array, noisy: bool
) -> Array:
    """(rows, states + inputs): bound of |x^ - x| and |k^ - k|, the largest over the nominal flights.

    Args:
        model: of the filter.
        nominals: such as with the fault and without: the inputs of the adaptive flight lie between.
        effectiveness: (rows, inputs), k as it is declared.
        floor: (states + inputs,), always added: rounding and integration.
        noisy: whether sensors are, so that the filter's deviation counts.
    """
    bound = np.zeros((len(effectiveness), len(floor)))
    for nominal in nominals:
        bound = np.maximum(bound, _response(model, nominal, effectiveness, noisy))
    return np.asarray(MARGIN * bound + floor, dtype=np.float64)


def _response(model: FilterModel, nominal: Nominal, effectiveness: Array, noisy: bool) -> Array:
    """Linear error after the steps of k, and the filter's deviations where noise drives it."""
    rows, n = nominal.state.shape
    faults = list(model.fallible)
    size = n + len(faults)
    q, r = np.diag(model.process_noise), np.diag(model.measurement_noise)
    covariance = np.diag(model.initial_covariance)
    error, found = np.zeros(size), np.zeros((rows, n + effectiveness.shape[1]))
    error[n:] = 1.0 - effectiveness[0, faults]
    for i in range(rows):
        if i > 0:
            x, u, k = nominal.state[i - 1], nominal.command[i - 1], effectiveness[i - 1]
            phi = _transition(model, x, u, k)
            covariance = phi @ covariance @ phi.T + q
            h = _observation(model, nominal.state[i], size)
            gain = np.linalg.solve(h @ covariance @ h.T + r, h @ covariance).T
            keep = np.eye(size) - gain @ h
            covariance = keep @ covariance @ keep.T + gain @ r @ gain.T
            error = keep @ (phi @ error)
            error[n:] -= effectiveness[i, faults] - effectiveness[i - 1, faults]
        spread = SIGMAS * np.sqrt(np.diag(covariance)) if noisy else np.zeros(size)
        total = np.abs(error) + spread
        found[i, :n] = total[:n]
        found[i, [n + fault for fault in faults]] = total[n:]
    return found


def _transition(model: FilterModel, x: Array, u: Array, k: Array) -> Array:
    n, size = len(x), len(x) + len(model.fallible)
    phi, scratch = np.eye(size), np.zeros((5, n))
    for j in range(size):
        ends = []
        for sign in (1.0, -1.0):
            state, factors = x.copy(), k.copy()
            if j < n:
                step = RELATIVE_STEP * max(1.0, abs(x[j]))
                state[j] += sign * step
            else:
                step = RELATIVE_STEP
                factors[model.fallible[j - n]] += sign * step
            model.propagate(False, state, u, factors, model.parameters, model.dt, scratch)
            ends.append(state)
        phi[:n, j] = (ends[0] - ends[1]) / (2.0 * step)
    return phi


def _observation(model: FilterModel, x: Array, size: int) -> Array:
    m = len(model.measurement_noise)
    h, seen = np.zeros((m, size)), np.zeros((2, m))
    for j in range(len(x)):
        step = RELATIVE_STEP * max(1.0, abs(x[j]))
        for end, sign in enumerate((1.0, -1.0)):
            state = x.copy()
            state[j] += sign * step
            model.outputs(state, model.parameters, seen[end])
        h[:, j] = (seen[0] - seen[1]) / (2.0 * step)
    return h
