"""Lie derivatives (12)-(13), the linearizability index of each output, and F, G, A, B, C of (14)-(15)."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import sympy as sp

from ftc_jsb.errors import TheoryError
from ftc_jsb.theory.approximation import Approximation, approximate
from ftc_jsb.theory.system import System

PROBES = 7  # random points at which an expression must vanish before it is called zero
PROBE_TOLERANCE = 1e-9


@dataclass(frozen=True)
class Linearization:
    """Input-output form (15) of a system."""

    system: System
    approximation: Approximation
    index: tuple[int, ...]  # r_i of each output, found
    chain: sp.Matrix  # [y_1, ..., y_1^(r_1 - 1), ..., y_n, ...]: the x of (15)
    drift: sp.Matrix  # script F of (14), (n, 1)
    gain: sp.Matrix  # script G of (14), (n, n)

    @property
    def order(self) -> int:
        """Length of e and Y_m of (16): the sum of the indices."""
        return sum(self.index)

    def brunovsky(self) -> tuple[npt.NDArray[np.float64], ...]:
        """A, B and C of (14): chains of integrators, one for each output."""
        n = self.order
        a, b = np.zeros((n, n)), np.zeros((n, len(self.index)))
        c = np.zeros((len(self.index), n))
        start = 0
        for output, index in enumerate(self.index):
            for step in range(index - 1):
                a[start + step, start + step + 1] = 1.0
            b[start + index - 1, output] = 1.0
            c[output, start] = 1.0
            start += index
        return a, b, c


def linearize(system: System) -> Linearization:
    """Differentiate each output until an input appears.

    u_n counts as constant in the Lie derivatives. That is no approximation below the index: where
    dh/dx dF/du vanishes for every u_n, dh/dx F does not depend on the input at all, and so not on
    u_n either.

    Raises:
        TheoryError: an output that no input reaches in as many derivatives as there are states.
    """
    approximation = approximate(system)
    states = list(system.states)
    index, chain, drift, gain = [], [], [], []
    for number, output in enumerate(system.outputs):
        derivative = sp.sympify(output)
        for order in range(1, len(states) + 1):
            row = sp.Matrix([derivative]).jacobian(states)
            chain.append(derivative)
            reached = row * approximation.g  # L_gk L_f^(r-1) h of (13)
            following = (row * approximation.f)[0]  # L_f^r h
            if any(not is_zero(element, number) for element in reached):
                index.append(order)
                drift.append(following)
                gain.append(list(reached))
                break
            # Below the index nothing depends on u_n; saying so keeps the expressions small.
            derivative = following.subs(dict.fromkeys(approximation.trim, 0))
            if derivative.has(sp.nan, sp.zoo):
                derivative = sp.simplify(following)
        else:
            raise TheoryError(
                f"system {system.name!r}: output {number} ({output}) has no linearizability index: no "
                f"input reaches it within {len(states)} derivatives"
            )
    return Linearization(
        system, approximation, tuple(index), sp.Matrix(chain), sp.Matrix(drift), sp.Matrix(gain)
    )


def is_zero(expression: sp.Expr, seed: int = 0) -> bool:
    """Whether an expression vanishes identically: at random points, before any simplification."""
    if expression.is_zero:
        return True
    symbols = sorted(expression.free_symbols, key=str)
    random = np.random.default_rng(seed)
    for _ in range(PROBES):
        point = {symbol: float(random.uniform(0.3, 1.3)) for symbol in symbols}
        value = complex(expression.evalf(subs=point))
        if abs(value) > PROBE_TOLERANCE:
            return False
    return True
