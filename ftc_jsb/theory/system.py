"""A nonaffine system (2) as SymPy expressions: x' = F(x, u, k), y = h(x)."""

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from ftc_jsb.errors import TheoryError

Symbols = tuple[sp.Symbol, ...]
Expressions = tuple[sp.Expr, ...]


@dataclass(frozen=True)
class System:
    """Definition of a system with one loss-of-effectiveness factor k_i for each input.

    The dynamics are F(x, u_c) of (1) in the efficacious inputs u_c; (2) follows by u_c = k u.
    """

    name: str
    states: Symbols
    inputs: Symbols  # u_c in `dynamics`
    parameters: Mapping[sp.Symbol, float]
    dynamics: Expressions  # F, one for each state
    outputs: Expressions  # h, functions of the states alone

    def __post_init__(self) -> None:
        """Check the definition.

        Raises:
            TheoryError: sizes that do not fit, unknown symbols, or m != n.
        """
        if len(self.dynamics) != len(self.states):
            raise TheoryError(
                f"system {self.name!r}: {len(self.dynamics)} rates for {len(self.states)} states"
            )
        if len(self.outputs) != len(self.inputs):
            raise TheoryError(
                f"system {self.name!r}: {len(self.outputs)} outputs (n) and {len(self.inputs)} inputs "
                "(m); the law inverts G of (14), which needs n = m"
            )
        known = {*self.states, *self.inputs, *self.parameters}
        for number, expression in enumerate(self.dynamics):
            unknown = expression.free_symbols - known
            if unknown:
                raise TheoryError(f"system {self.name!r}: rate {number}: unknown {_names(unknown)}")
        for number, expression in enumerate(self.outputs):
            unknown = expression.free_symbols - {*self.states, *self.parameters}
            if unknown:
                raise TheoryError(
                    f"system {self.name!r}: output {number}: {_names(unknown)} is no state or parameter"
                )

    @property
    def effectiveness(self) -> Symbols:
        """The factors k_i of (2), one for each input."""
        return tuple(sp.Symbol(f"k_{symbol.name}", positive=True) for symbol in self.inputs)

    @property
    def faulty_dynamics(self) -> sp.Matrix:
        """F(x, u, k) of (2), in the commanded inputs."""
        lost = {
            symbol: factor * symbol
            for symbol, factor in zip(self.inputs, self.effectiveness, strict=True)
        }
        return sp.Matrix([expression.subs(lost, simultaneous=True) for expression in self.dynamics])


def _names(symbols: set[sp.Basic]) -> str:
    return ", ".join(sorted(str(symbol) for symbol in symbols))
