"""How far the joint estimate (20)-(34) is from the truth along a flight that is told state and fault.

The filter sees what that flight would measure, without noise; its error is what the steps of k make. A
component of the error may pass through zero while the others are large, and the adaptive flight's inputs
differ from those of this one. So the envelope of a component falls no faster than the error does in the
norm of the inverse covariance, in which a Kalman filter contracts.
"""

import math

import numpy as np

from ftc_jsb.compiled import compiled
from ftc_jsb.estimation.cholesky import cholesky, cholesky_solve
from ftc_jsb.vocabulary.kernel_types import Matrix, Vector

from .arrays import copy, fill
from .joint_filter import ESTIMATED, SOUND, FilterSettings, effectiveness_of, estimate
from .system import FALLIBLE, MEASURED, STATES, outputs


@compiled
def respond(
    flight: tuple[Matrix, Matrix, Matrix],
    p: Vector,
    settings: FilterSettings,
    covariance: Matrix,
    envelope: Matrix,
    deviation: Matrix,
    told: Matrix,
) -> int:
    """Envelope of the error, and the filter's deviations, along a flight.

    Args:
        flight: state (rows, states); command (rows, inputs); k (rows, inputs). The estimate starts at the
            state, and at k = 1.
        p: (parameters,).
        settings: of the filter.
        covariance: (states + faults, states + faults), at the start; overwritten.
        envelope: (rows, states + faults), receives it.
        deviation: (rows, states + faults), receives the square roots of the variances.
        told: (rows, inputs), receives the estimate of k; 1 where none is estimated.

    Returns:
        SOUND, or the filter's status where it failed.
    """
    state, command, effectiveness = flight
    z, y, error, last = np.ones(ESTIMATED), np.empty(MEASURED), np.empty(ESTIMATED), 0.0
    copy(state[0], z)
    for i in range(len(state)):
        if i > 0:
            outputs(state[i], p, y)
            status = estimate(z, covariance, command[i - 1], y, p, settings)
            if status != SOUND:
                return status
        for j in range(STATES):
            error[j] = z[j] - state[i, j]
        fill(told[i], 1.0)
        effectiveness_of(z, told[i])
        for j in range(len(FALLIBLE)):
            error[STATES + j] = z[STATES + j] - effectiveness[i, FALLIBLE[j]]
        now = _size(error, covariance)
        decay = min(now / last, 1.0) if last > 0.0 else 0.0
        last = now
        for j in range(ESTIMATED):
            before = envelope[i - 1, j] if i > 0 else 0.0
            envelope[i, j] = max(abs(error[j]), decay * before)
            deviation[i, j] = math.sqrt(max(covariance[j, j], 0.0))
    return SOUND


@compiled
def _size(error: Vector, covariance: Matrix) -> float:
    """The error in the norm of the inverse covariance."""
    root, solved = np.zeros((ESTIMATED, ESTIMATED)), np.empty(ESTIMATED)
    cholesky(covariance, ESTIMATED, root)
    copy(error, solved)
    cholesky_solve(root, ESTIMATED, solved)
    total = 0.0
    for j in range(ESTIMATED):
        total += error[j] * solved[j]
    return math.sqrt(max(total, 0.0))
