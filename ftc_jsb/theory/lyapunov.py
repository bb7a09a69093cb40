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

Errors that neither K nor H couples, such as those of each output, have a V each, so that a disturbance
in m/s bounds no angle; V is their sum.

Nothing of the flight is in it. A flight is outside the proof where it breaks an assumption, and
against it where V exceeds its bound.
"""

import itertools
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.theory.constants import ProofConstants
from ftc_jsb.theory.gains import Gains
from ftc_jsb.theory.root_bound import integrate_root

Array = npt.NDArray[np.float64]
Places = npt.NDArray[np.intp]
ROUNDING = 1e-9
COUPLED = 1e-12  # of the largest element of H: less is rounding


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
    predicted: Array  # (rows,), bound of ||e|| at each time
    predicted_each: Array  # (rows, order), of |e_i|: sqrt(V (H^-1)_ii) of its part of V
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
    a, b = matrices
    fastest = float(eigh(gains.q, gains.h, eigvals_only=True).min())
    mu = young * fastest
    rate = float(fastest - mu)
    blocks = [
        _block(flown.error[0], place, bound, (a, b), gains, dt) for place in _places(gains, b)
    ]
    predicted = np.sum([block.bound for block in blocks], axis=0)
    phi = float(np.sum([block.square for block in blocks], axis=0).max() / mu)
    each = np.empty_like(flown.error)
    for block in blocks:
        each[:, block.place] = block.each
    least = float(np.linalg.eigvalsh(gains.h).min())
    value = np.einsum("ti,ij,tj->t", flown.error, gains.h, flown.error)
    return LyapunovBound(
        value,
        predicted,
        rate,
        phi,
        float(np.sqrt(phi / (rate * least))),
        np.linalg.norm(each, axis=1),
        each,
        np.linalg.norm(flown.error, axis=1),
        broken_assumptions(flown, assumptions) + _held_too_long(matrices, gains, fastest, dt),
    )


class _Block(NamedTuple):
    """Errors that no other errors act on, and that have a V of their own."""

    place: Places  # of them in e
    bound: Array  # (rows,), of its part of V
    square: Array  # (rows,), bound of d^T B^T H B d
    each: Array  # (rows, errors), bound of |e_i|


def _places(gains: Gains, b: Array) -> list[Places]:
    """Places in e of the parts that neither K nor H couples, such as those of each output."""
    from scipy.sparse.csgraph import connected_components

    chains = np.cumsum(np.roll(b.any(axis=1), 1))
    coupled = (b @ gains.k != 0.0) | (np.abs(gains.h) > COUPLED * np.abs(gains.h).max())
    coupled |= chains[:, None] == chains
    count, part = connected_components(coupled, directed=False)
    return [np.flatnonzero(part == number) for number in range(count)]


def _block(
    start: Array,
    place: Places,
    bound: Array,
    matrices: tuple[Array, Array],
    gains: Gains,
    dt: float,
) -> _Block:
    """Bound of a part of V from its first value on."""
    from scipy.linalg import eigh

    inputs = np.flatnonzero(matrices[1][place].any(axis=0))
    corner = np.ix_(place, place)
    a, b = matrices[0][corner], matrices[1][np.ix_(place, inputs)]
    part = Gains(gains.k[np.ix_(inputs, place)], gains.h[corner], gains.q[corner])
    fastest = float(eigh(part.q, part.h, eigvals_only=True).min())
    signs = np.array(list(itertools.product((1.0, -1.0), repeat=len(inputs))))
    found, square = np.empty(len(bound)), np.empty(len(bound))
    first = start[place]
    integrate_root(
        float(np.sqrt(first @ part.h @ first)),
        np.ascontiguousarray(bound[:, inputs], dtype=float),
        (b.T @ part.h @ b, signs, _returned(part, a - b @ part.k), np.abs(part.k @ b)),
        0.5 * fastest,
        dt,
        found,
        square,
    )
    return _Block(place, found, square, np.sqrt(np.outer(found, np.diag(np.linalg.inv(part.h)))))


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
