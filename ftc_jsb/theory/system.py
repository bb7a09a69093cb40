"""A nonaffine system (2) as SymPy expressions: x' = F(x, u, k), y = h(x)."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import sympy as sp

from ftc_jsb.errors import TheoryError

Symbols = tuple[sp.Symbol, ...]
Expressions = tuple[sp.Expr, ...]
Range = tuple[float, float]

STATE_RANGE: Range = (-1.0, 1.0)  # of a state or an input that is given none
EFFECTIVENESS_RANGE: Range = (0.3, 1.0)


@dataclass(frozen=True)
class System:
    """Definition of a system with a loss-of-effectiveness factor k_i for each input.

    The dynamics are F(x, u_c) of (1) in the efficacious inputs u_c; (2) follows by u_c = k u.
    """

    name: str
    states: Symbols
    inputs: Symbols  # u_c in `dynamics`; with more of them than outputs the law allocates
    parameters: Mapping[sp.Symbol, float]
    dynamics: Expressions  # F, one for each state
    outputs: Expressions  # h, functions of the states alone: what is tracked
    measured: Expressions = ()  # what the filter is given; the outputs if not said
    fallible: Symbols = ()  # inputs whose effectiveness is estimated; all if not said
    ranges: Mapping[sp.Symbol, Range] = field(default_factory=dict)  # Omega_x, of states, inputs, k

    def __post_init__(self) -> None:
        """Check the definition.

        Raises:
            TheoryError: sizes that do not fit, unknown symbols, fewer inputs than outputs, or a range
                that is none.
        """
        object.__setattr__(self, "measured", self.measured or self.outputs)
        object.__setattr__(self, "fallible", self.fallible or self.inputs)
        if len(self.dynamics) != len(self.states):
            raise self._error(f"{len(self.dynamics)} rates for {len(self.states)} states")
        if len(self.outputs) > len(self.inputs):
            raise self._error(
                f"{len(self.outputs)} outputs (n) and {len(self.inputs)} inputs (m); the law inverts G "
                "of (14), which needs at least as many inputs as outputs"
            )
        self._check_symbols()
        self._check_ranges()

    def _check_symbols(self) -> None:
        known = {*self.states, *self.inputs, *self.parameters}
        for number, expression in enumerate(self.dynamics):
            unknown = sp.sympify(expression).free_symbols - known
            if unknown:
                raise self._error(f"rate {number}: unknown {_names(unknown)}")
        for kind, expressions in (("output", self.outputs), ("measured", self.measured)):
            for number, expression in enumerate(expressions):
                unknown = sp.sympify(expression).free_symbols - {*self.states, *self.parameters}
                if unknown:
                    raise self._error(
                        f"{kind} {number}: {_names(unknown)} is no state or parameter"
                    )
        unknown = set(self.fallible) - set(self.inputs)
        if unknown:
            raise self._error(f"fallible: {_names(unknown)} is no input")

    def _check_ranges(self) -> None:
        known = {*self.states, *self.inputs, *self.effectiveness}
        for symbol, (low, high) in self.ranges.items():
            if symbol not in known:
                raise self._error(f"ranges: {symbol} is no state, input or effectiveness")
            if not low < high:
                raise self._error(f"ranges: {symbol} from {low} to {high}; expected low < high")

    def _error(self, text: str) -> TheoryError:
        return TheoryError(f"system {self.name!r}: {text}")

    def range_of(self, symbol: sp.Symbol) -> Range:
        """Between which values the theory's constants hold for a state, an input or a factor k."""
        default = EFFECTIVENESS_RANGE if symbol in self.effectiveness else STATE_RANGE
        return self.ranges.get(symbol, default)

    @cached_property
    def effectiveness(self) -> Symbols:
        """The factors k_i of (2), one for each input."""
        return tuple(effectiveness_symbol(symbol) for symbol in self.inputs)

    @property
    def faulty_dynamics(self) -> sp.Matrix:
        """F(x, u, k) of (2), in the commanded inputs."""
        lost = {
            symbol: factor * symbol
            for symbol, factor in zip(self.inputs, self.effectiveness, strict=True)
        }
        return sp.Matrix([sp.sympify(rate).xreplace(lost) for rate in self.dynamics])


def effectiveness_symbol(symbol: sp.Symbol) -> sp.Symbol:
    """The factor k of an input."""
    return sp.Symbol(f"k_{symbol.name}", positive=True)


def _names(symbols: set[sp.Basic]) -> str:
    return ", ".join(sorted(str(symbol) for symbol in symbols))
