"""Gain K of the law (17), by LQR, by pole placement or given, and H of the Lyapunov equation (19)."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.errors import TheoryError

Array = npt.NDArray[np.float64]


class Gains(NamedTuple):
    """A stabilising gain and the quadratic form that shows it."""

    k: Array  # (n, order): K_c^T of (17)
    h: Array  # (order, order), symmetric, positive definite
    q: Array  # (order, order), symmetric, positive definite


def lqr_gains(a: Array, b: Array, weight: Array, effort: Array, q: Array | None = None) -> Gains:
    """K = R^-1 B^T P with P of the algebraic Riccati equation, which (19) is called in the paper.

    Args:
        a, b: of (14).
        weight, effort: of the quadratic cost, positive definite.
        q: of (19); the identity if not given.

    Raises:
        TheoryError: a weight that is not positive definite.
    """
    from scipy.linalg import solve_continuous_are

    _positive("weight", weight)
    _positive("effort", effort)
    riccati = solve_continuous_are(a, b, weight, effort)
    return given_gains(
        a, b, np.asarray(np.linalg.solve(effort, b.T @ riccati), dtype=np.float64), q
    )


def placed_gains(a: Array, b: Array, poles: Array, q: Array | None = None) -> Gains:
    """K that puts the poles of A - B K where they are wanted.

    Raises:
        TheoryError: poles that cannot be placed, or are not in the left half plane.
    """
    from scipy.signal import place_poles

    try:
        k = place_poles(a, b, poles).gain_matrix
    except ValueError as error:
        raise TheoryError(f"poles {np.asarray(poles).tolist()} cannot be placed: {error}") from None
    return given_gains(a, b, k, q)


def given_gains(a: Array, b: Array, k: Array, q: Array | None = None) -> Gains:
    """A given K, with H from (19): (A - B K)^T H + H (A - B K) = -Q.

    Raises:
        TheoryError: Q is not symmetric positive definite, or A - B K is not Hurwitz.
    """
    from scipy.linalg import solve_continuous_lyapunov

    q = np.eye(len(a)) if q is None else np.asarray(q, dtype=float)
    _positive("Q of (19)", q)
    k = np.asarray(k, dtype=float)
    if k.shape != (b.shape[1], b.shape[0]):
        raise TheoryError(f"K has shape {k.shape}; expected {(b.shape[1], b.shape[0])}")
    closed = a - b @ k
    worst = float(np.linalg.eigvals(closed).real.max())
    if worst >= 0.0:
        raise TheoryError(f"A - B K is not Hurwitz: an eigenvalue has real part {worst:.3g}")
    h = solve_continuous_lyapunov(closed.T, -q)
    return Gains(k, np.asarray((h + h.T) / 2.0, dtype=np.float64), q)


def decaying_gains(a: Array, b: Array, k: Array, rate: float) -> Gains:
    """A given K, with H and Q of (19) such that V decays at 2 `rate` at least: H^-1 Q >= 2 rate.

    H solves (19) for A - B K + rate I and the identity, and Q is what (19) then has for A - B K.

    Raises:
        TheoryError: A - B K has an eigenvalue whose real part is not below -rate.
    """
    shifted = given_gains(a + rate * np.eye(len(a)), b, k)
    return given_gains(a, b, k, shifted.q + 2.0 * rate * shifted.h)


def _positive(name: str, matrix: Array) -> None:
    matrix = np.asarray(matrix, dtype=float)
    if not np.allclose(matrix, matrix.T):
        raise TheoryError(f"{name} is not symmetric")
    least = float(np.linalg.eigvalsh(matrix).min())
    if least <= 0.0:
        raise TheoryError(f"{name} is not positive definite: its least eigenvalue is {least:.3g}")
