"""The proof of section 4.2 in numbers that are known before the flight, and whether a flight obeys.

With e' = (A - B K) e + B d and d what the law does not count on, (39) without its slips reads

    V' <= -lambda V + phi(t),  lambda = lambda_0 - mu_1,  phi = d^T B^T H B d / mu_1,

lambda_0 the least eigenvalue of H^-1 Q, which is no less than the paper's lambda_min(Q) / lambda_max(H), and
0 < mu_1 < lambda_0. Its sup of phi gives the ball (40), and phi(t) itself, with
the best mu_1 at each time, a far nearer bound of V. Each component of d is bounded by constants over
the ranges of the system:

    |d_i| <= sum_j P_ij |x~_j|                  estimation: (35), P of the exact derivative at the flown u
           + sum_jl |K_ij| C_jl |x~_l|          the error that is fed back is that of the estimate
           + 1/2 sum_jl M_ijl |u - u_n|_j |u - u_n|_l   O(.) of (7), at the estimate
           + dt (S_i + |y_m^(r+1)|_i + |K e'|_i)        a command is held for a sample
           + what the plant is known to differ by.

Nothing of the flight is in it. A flight is outside the proof where it breaks an assumption, and
against it where V exceeds its bound.
"""

import itertools
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.theory.constants import ProofConstants
from ftc_jsb.theory.gains import Gains

Array = npt.NDArray[np.float64]
ROUNDING = 1e-9
UNBOUNDED = (
    1e100  # where the bound runs away: the gains are too large for the time a command is held
)


class Assumptions(NamedTuple):
    """What is taken for granted before the flight, and looked at after it."""

    estimation: Array  # (rows, states + inputs), bound of |[x^ - x, k^ - k]|
    step: Array  # (rows, inputs), bound of |u - u_n|
    model: Array  # (outputs,), bound of what the plant's y^(r) differs from the model's by
    low: Array  # (states + inputs,), the box of the constants
    high: Array


class Flown(NamedTuple):
    """What the proof looks at of a flight, a row for each sample."""

    time: Array
    error: Array  # (rows, order), e of (16)
    state: Array  # (rows, states)
    effectiveness: Array  # (rows, inputs)
    known: Array  # (rows, states + inputs), what the law was told
    wanted: Array  # (rows, inputs), before limits
    command: Array  # (rows, inputs)
    trim: Array  # (rows, inputs)


class LyapunovBound(NamedTuple):
    """The quantities of (37)-(40), predicted, beside those of a flight."""

    value: Array  # (rows,), V = e^T H e of the flight
    bound: Array  # (rows,), of V, predicted
    rate: float  # lambda [1/s]
    disturbance: float  # phi, its supremum
    radius: float  # of the ball (40)
    predicted: Array  # (rows,), sqrt(bound / lambda_min(H)): bound of ||e|| at each time
    error: Array  # (rows,), ||e|| of the flight
    broken: tuple[str, ...]  # assumptions that the flight does not keep

    @property
    def obeyed(self) -> bool:
        """Whether the assumptions hold and V stays below its bound all along."""
        return not self.broken and self.below

    @property
    def below(self) -> bool:
        """Whether V stays below its bound all along."""
        return bool(np.all(self.value <= self.bound * (1.0 + ROUNDING)))


def disturbance_bound(
    constants: ProofConstants, gain: Array, assumptions: Assumptions, rate: Array, dt: float
) -> Array:
    """(rows, outputs): bound of |d|, but for the error that a held command adds.

    Args:
        constants: over the box.
        gain: K, (outputs, order).
        assumptions: of the flight.
        rate: (rows, outputs), |y_m^(r+1)|.
        dt: sample time [s].
    """
    estimation = assumptions.estimation
    states = constants.chain.shape[1]
    known = estimation @ constants.sensitivity.T
    fed_back = estimation[:, :states] @ (np.abs(gain) @ constants.chain).T
    step = assumptions.step
    remainder = 0.5 * np.einsum("ijl,tj,tl->ti", constants.curvature, step, step)
    hold = dt * (constants.drift + rate)
    return np.asarray(known + fed_back + remainder + hold + assumptions.model, dtype=np.float64)


def lyapunov_bound(
    flown: Flown,
    bound: Array,
    assumptions: Assumptions,
    matrices: tuple[Array, Array],
    gains: Gains,
    young: float = 0.5,
) -> LyapunovBound:
    """Predict V and see whether a flight obeys.

    Args:
        flown: the flight; of it only the first error enters the prediction.
        bound: (rows, outputs), of |d|, as `disturbance_bound` gives it.
        assumptions: that it was made with.
        matrices: A and B of (14).
        gains: K, H and Q.
        young: mu_1 as a part of its upper limit, between 0 and 1.
    """
    from scipy.linalg import eigh

    dt = float(flown.time[1] - flown.time[0])
    fastest = float(eigh(gains.q, gains.h, eigvals_only=True).min())
    a, b = matrices
    least = float(np.linalg.eigvalsh(gains.h).min())
    mu = young * fastest
    rate = float(fastest - mu)
    value = np.einsum("ti,ij,tj->t", flown.error, gains.h, flown.error)
    predicted, phi = _integrate(value[0], bound, (b, gains, a - b @ gains.k), (fastest, mu), dt)
    return LyapunovBound(
        value,
        predicted,
        rate,
        phi,
        float(np.sqrt(phi / (rate * least))),
        np.sqrt(predicted / least),
        np.linalg.norm(flown.error, axis=1),
        broken_assumptions(flown, assumptions) + _held_too_long(matrices, gains, fastest, dt),
    )


def _integrate(
    start: float,
    bound: Array,
    loop: tuple[Array, Gains, Array],
    rates: tuple[float, float],
    dt: float,
) -> tuple[Array, float]:
    """Bound of V from V(0) on, and the largest phi for the given mu_1.

    For every mu_1 (39) holds at each time; the best, mu_1 = w / sqrt(V) with w = ||H^(1/2) B d||, makes
    it sqrt(V)' <= -lambda_0 / 2 sqrt(V) + w. A held command adds dt |K e'| to d,
    e' = (A - B K) e + B d, with e by the bound of V itself.
    """
    b, gains, closed = loop
    fastest, mu = rates
    weight = b.T @ gains.h @ b
    signs = np.array(list(itertools.product((1.0, -1.0), repeat=b.shape[1])))
    returned = _returned(gains, closed)
    direct = np.abs(gains.k @ b)
    decay = np.exp(-0.5 * fastest * dt)
    predicted, largest, root = np.empty(len(bound)), 0.0, np.sqrt(max(start, 0.0))
    for i, d in enumerate(bound):
        predicted[i] = root**2
        whole = np.minimum(d + dt * (returned * root + direct @ d), UNBOUNDED)
        corners = signs * whole
        square = float(np.einsum("si,ij,sj->s", corners, weight, corners).max())
        largest = max(largest, square / mu)
        root = decay * root + (1.0 - decay) / (0.5 * fastest) * np.sqrt(square)
    return predicted, largest


def _returned(gains: Gains, closed: Array) -> Array:
    """(outputs,): |K (A - B K) e| is at most this times sqrt(V)."""
    root = np.linalg.cholesky(gains.h)
    return np.asarray(np.linalg.norm(np.linalg.solve(root, (gains.k @ closed).T), axis=0))


def _held_too_long(
    matrices: tuple[Array, Array], gains: Gains, fastest: float, dt: float
) -> tuple[str, ...]:
    """Why there is no bound, where a held command takes V up faster than the gains bring it down."""
    a, b = matrices
    root = np.linalg.cholesky(gains.h)
    gained = dt * np.linalg.norm(root.T @ b, 2) * np.linalg.norm(_returned(gains, a - b @ gains.k))
    return ("a command is held too long for the gains",) if gained >= 0.5 * fastest else ()


def broken_assumptions(flown: Flown, assumptions: Assumptions) -> tuple[str, ...]:
    """In words, with the time at which each is broken first."""
    truth = np.concatenate([flown.state, flown.effectiveness], axis=1)
    inputs = flown.command.shape[1]
    at = np.concatenate([flown.state, flown.command], axis=1)
    slack = ROUNDING * (1.0 + np.abs(at))
    checks = {
        "the estimate errs by more than assumed": np.abs(flown.known - truth)
        > assumptions.estimation,
        "u - u_n is larger than assumed": np.abs(flown.command - flown.trim)
        > assumptions.step + slack[:, -inputs:],
        "a limit holds the command": np.abs(flown.wanted - flown.command) > slack[:, -inputs:],
        "outside the ranges of the constants": (at < assumptions.low - slack)
        | (at > assumptions.high + slack),
        "not finite": ~np.isfinite(np.concatenate([flown.error, at], axis=1)),
    }
    found = []
    for words, broken in checks.items():
        rows = broken.any(axis=1)
        if rows.any():
            found.append(f"{words} at {flown.time[int(np.argmax(rows))]:.2f} s")
    return tuple(found)
