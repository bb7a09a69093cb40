"""What the outputs do not show: the zeros of the linearised system at a point.

Where the indices add up to less than the number of states, the law holds the outputs and leaves the
rest to itself. Its motion near a point is stable where the invariant zeros of x' = A x + B u, y = C x,
of the system linearised there, are in the left half plane (Isidori, Nonlinear Control Systems, 4.3).
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import sympy as sp

from ftc_jsb.theory.linearization import Linearization

Array = npt.NDArray[np.float64]
MARGINAL = 1e-7  # real part over the size of the zero, or of 1/s: neither stable nor unstable


class ZeroDynamics(NamedTuple):
    """Of the system at a point."""

    dimension: int  # states less the sum of the indices
    zeros: npt.NDArray[np.complex128]  # [1/s], of the linearisation

    @property
    def verdict(self) -> str:
        """None, stable, unstable, or not decided by the linearisation."""
        if self.dimension == 0:
            return "none"
        real = self.zeros.real / np.maximum(np.abs(self.zeros), 1.0)
        if len(real) and real.max() > MARGINAL:
            return "unstable"
        if len(real) < self.dimension or real.max() > -MARGINAL:
            return "undecided"
        return "stable"


def zero_dynamics(
    linearization: Linearization, state: Sequence[float], trim: Sequence[float]
) -> ZeroDynamics:
    """Invariant zeros at a point, healthy inputs.

    With more inputs than outputs the inputs move as the law's allocation has them move: by W G^T.

    Args:
        linearization: of the system.
        state: (states,).
        trim: (inputs,).
    """
    system = linearization.system
    dimension = len(system.states) - linearization.order
    if dimension == 0:
        return ZeroDynamics(0, np.empty(0, complex))
    at = {
        **system.parameters,
        **dict(zip(system.states, map(float, state), strict=True)),
        **dict(zip(system.inputs, map(float, trim), strict=True)),
        **dict(zip(linearization.approximation.trim, map(float, trim), strict=True)),
        **dict.fromkeys(system.effectiveness, 1.0),
    }
    rates = system.faulty_dynamics
    a = _numbers(rates.jacobian(list(system.states)), at)
    b = _numbers(rates.jacobian(list(system.inputs)), at)
    c = _numbers(sp.Matrix(system.outputs).jacobian(list(system.states)), at)
    if b.shape[1] > c.shape[0]:
        weight = np.diag(input_scale(linearization) ** 2)
        b = b @ weight @ _numbers(linearization.gain, at).T
    return ZeroDynamics(dimension, _invariant_zeros(a, b, c))


def input_scale(linearization: Linearization) -> Array:
    """(inputs,), the largest size of each input in its range."""
    system = linearization.system
    return np.array([max(map(abs, system.range_of(symbol))) for symbol in system.inputs], float)


def _numbers(matrix: sp.Matrix, at: dict[sp.Symbol, float]) -> Array:
    return np.array(matrix.subs(at).evalf().tolist(), dtype=float)


def _invariant_zeros(a: Array, b: Array, c: Array) -> npt.NDArray[np.complex128]:
    """Finite generalised eigenvalues of [A - s I, B; C, 0]."""
    from scipy.linalg import eig

    n, m = b.shape
    scale = np.maximum(np.abs(b).max(axis=0), 1e-300)
    rosenbrock = np.block([[a, b / scale], [c, np.zeros((len(c), m))]])
    pencil = np.zeros_like(rosenbrock)
    pencil[:n, :n] = np.eye(n)
    alpha, beta = eig(rosenbrock, pencil, right=False, homogeneous_eigvals=True)
    finite = np.abs(beta) > 1e-9 * np.maximum(np.abs(alpha), 1.0)
    return np.asarray(alpha[finite] / beta[finite], dtype=np.complex128)
