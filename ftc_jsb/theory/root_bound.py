"""The bound of sqrt(V) that (39) gives with the best mu_1 at each time, a sample after another."""

import math

import numpy as np

from ftc_jsb.compiled import compiled
from ftc_jsb.vocabulary.kernel_types import Matrix, Vector

UNBOUNDED = 1e100  # of |d|: the gains are too large for the time that a command is held


@compiled
def integrate_root(
    root: float,
    bound: Matrix,
    loop: tuple[Matrix, Matrix, Vector, Matrix],
    decay: float,
    dt: float,
    predicted: Vector,
    square: Vector,
) -> None:
    """For every mu_1 (39) holds at each time; the best, mu_1 = w / sqrt(V) with w = ||H^(1/2) B d||, makes
    it sqrt(V)' <= -decay sqrt(V) + w. A held command adds dt |K e'| to d, e' = (A - B K) e + B d, with e by
    the bound of V itself. |d| is bounded by element, so w is largest where each has one of its two signs.

    Args:
        root: sqrt(V) at the start.
        bound: (rows, outputs), of |d|.
        loop: B^T H B; (2^outputs, outputs), the signs; |K e'| <= (outputs,) sqrt(V) + |K B| d.
        decay: lambda_0 / 2 [1/s].
        dt: sample time [s].
        predicted: (rows,), receives the bound of V.
        square: (rows,), receives w^2.
    """
    weight, signs, returned, direct = loop
    n = bound.shape[1]
    kept = math.exp(-decay * dt)
    whole = np.empty(n)
    for i in range(len(bound)):
        predicted[i] = root**2
        for a in range(n):
            held = returned[a] * root
            for b in range(n):
                held += direct[a, b] * bound[i, b]
            whole[a] = min(bound[i, a] + dt * held, UNBOUNDED)
        square[i] = 0.0
        for corner in range(len(signs)):
            found = 0.0
            for a in range(n):
                for b in range(n):
                    found += (
                        signs[corner, a] * whole[a] * weight[a, b] * signs[corner, b] * whole[b]
                    )
            square[i] = max(square[i], found)
        root = kept * root + (1.0 - kept) / decay * math.sqrt(square[i])
