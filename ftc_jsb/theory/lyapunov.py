"""The proof of section 4.2 in numbers: V of (37), lambda and phi of (39), the ball of (40).

With e' = (A - B K) e + B d, where d is all that the law did not count on (the estimation error
P x~ of (36), the remainder O(.) of (4), the hold of a sample, a limit),

    V' <= -lambda V + phi(t),   lambda = lambda_min(Q) / lambda_max(H) - mu_1,
    phi = sup d^T B^T H B d / mu_1,

which is (39) without its slips: the first term bounds e^T Q e by lambda_min(Q) ||e||^2, and mu_1 must
lie below lambda_min(Q) / lambda_max(H). Hence V(t) <= exp(-lambda t) V(0) + phi / lambda at every t,
and (40) in the end. Errors are scaled first, since (40) adds m/s to rad.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.theory.gains import Gains

Array = npt.NDArray[np.float64]


class LyapunovBound(NamedTuple):
    """The quantities of (37)-(40) along a flight."""

    value: Array  # (rows,), V = e^T H e of the scaled error
    bound: Array  # (rows,), exp(-lambda t) V(0) + phi / lambda
    rate: float  # lambda [1/s]
    disturbance: float  # phi
    radius: float  # of the ball (40): of the scaled error
    error: Array  # (rows,), ||e|| scaled

    @property
    def obeyed(self) -> bool:
        """Whether V stays below its bound all along."""
        return bool(np.all(self.value <= self.bound * (1.0 + 1e-9)))


def lyapunov_bound(
    time: Array, error: Array, residual: Array, b: Array, gains: Gains, young: float = 0.5
) -> LyapunovBound:
    """Check a flight against the proof.

    Args:
        time: (rows,) [s].
        error: (rows, order), e of (16), scaled: the gains must be those of the scaled error.
        residual: (rows, outputs), d, scaled alike.
        b: (order, outputs), B of (14).
        gains: K, H and Q.
        young: mu_1 as a part of its upper limit lambda_min(Q) / lambda_max(H), between 0 and 1.
    """
    fastest = np.linalg.eigvalsh(gains.q).min() / np.linalg.eigvalsh(gains.h).max()
    mu = young * fastest
    rate = float(fastest - mu)
    weight = b.T @ gains.h @ b
    phi = float(np.max(np.einsum("ti,ij,tj->t", residual, weight, residual)) / mu)
    value = np.einsum("ti,ij,tj->t", error, gains.h, error)
    bound = np.exp(-rate * (time - time[0])) * value[0] + phi / rate
    radius = float(np.sqrt(phi / (rate * np.linalg.eigvalsh(gains.h).min())))
    return LyapunovBound(value, bound, rate, phi, radius, np.linalg.norm(error, axis=1))
