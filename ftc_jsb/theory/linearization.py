"""Lie derivatives (12)-(13), the linearizability index of each output, and F, G, A, B, C of (14)-(15)."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import sympy as sp

from ftc_jsb.errors import TheoryError
from ftc_jsb.theory.approximation import Approximation, approximate
from ftc_jsb.theory.identically_zero import generic_rank, is_zero
from ftc_jsb.theory.system import Range, System


@dataclass(frozen=True)
class Linearization:
    """Input-output form (15) of a system."""

    system: System
    approximation: Approximation
    index: tuple[int, ...]  # r_i of each output, found
    chain: sp.Matrix  # [y_1, ..., y_1^(r_1 - 1), ..., y_n, ...]: the x of (15)
    drift: sp.Matrix  # script F of (14), (n, 1)
    gain: sp.Matrix  # script G of (14), (n, m)

    @property
    def order(self) -> int:
        """Length of e and Y_m of (16): the sum of the indices."""
        return sum(self.index)

    @property
    def highest(self) -> sp.Matrix:
        """The derivative y^(r) of each output in the exact system, (n, 1), in the inputs u."""
        states, rates = list(self.system.states), self.system.faulty_dynamics
        last = np.cumsum(self.index) - 1
        rows = [sp.Matrix([self.chain[int(place)]]).jacobian(states) for place in last]
        return sp.Matrix([(row * rates)[0] for row in rows])

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
        TheoryError: an output that no input reaches in as many derivatives as there are states, or G
            of (14) that has no full row rank anywhere.
    """
    approximation = approximate(system)
    index, chain, drift, gain = [], [], [], []
    for number in range(len(system.outputs)):
        derivatives, following, reached = _until_input(system, approximation, number)
        index.append(len(derivatives))
        chain += derivatives
        drift.append(following)
        gain.append(list(reached))
    linear = Linearization(
        system, approximation, tuple(index), sp.Matrix(chain), sp.Matrix(drift), sp.Matrix(gain)
    )
    rank = generic_rank(linear.gain, lambda symbol: range_of(linear, symbol))
    if rank < len(index):
        raise TheoryError(
            f"system {system.name!r}: G of (14) has rank {rank} everywhere, for {len(index)} outputs of "
            f"index {', '.join(map(str, index))}: the inputs that come first move too few of them"
        )
    return linear


def _until_input(
    system: System, approximation: Approximation, number: int
) -> tuple[list[sp.Expr], sp.Expr, sp.Matrix]:
    """Derivatives of an output below its index, L_f^r h, and the row of L_g L_f^(r-1) h."""
    output = sp.sympify(system.outputs[number])
    states, derivatives = list(system.states), [output]
    for _ in states:
        row = sp.Matrix([derivatives[-1]]).jacobian(states)
        reached = row * approximation.g  # L_gk L_f^(r-1) h of (13)
        following = (row * approximation.f)[0]  # L_f^r h
        if any(not _vanishes(element, system, approximation) for element in reached):
            return derivatives, following, reached
        derivatives.append(_without_trim(following, system, approximation))
    raise TheoryError(
        f"system {system.name!r}: output {number} ({output}) has no linearizability index: no "
        f"input reaches it within {len(states)} derivatives"
    )


def _without_trim(expression: sp.Expr, system: System, approximation: Approximation) -> sp.Expr:
    """Below the index nothing depends on u_n; saying so keeps the expressions small."""
    at_zero = expression.subs(dict.fromkeys(approximation.trim, 0))
    if not at_zero.has(sp.nan, sp.zoo, sp.oo, sp.AccumBounds):
        return at_zero
    middle = {
        trim: sp.nsimplify(sum(system.range_of(symbol)), rational=True) / 2
        for trim, symbol in zip(approximation.trim, system.inputs, strict=True)
    }
    return expression.subs(middle)


def _vanishes(expression: sp.Expr, system: System, approximation: Approximation) -> bool:
    return is_zero(expression, lambda symbol: _range(system, approximation, symbol))


def range_of(linearization: Linearization, symbol: sp.Symbol) -> Range:
    """Where a state, an input, its trim input, a factor k or a parameter lies."""
    return _range(linearization.system, linearization.approximation, symbol)


def _range(system: System, approximation: Approximation, symbol: sp.Symbol) -> Range:
    if symbol in system.parameters:
        value = float(system.parameters[symbol])
        return value, value
    trims = dict(zip(approximation.trim, system.inputs, strict=True))
    return system.range_of(trims.get(symbol, symbol))
