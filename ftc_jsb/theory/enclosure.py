"""The largest size of an expression over a box, enclosed: interval arithmetic and bisection.

Expressions are evaluated in arb's ball arithmetic (python-flint; Johansson 2017), whose results hold
every value that the expression takes for arguments in the balls. So the upper end is a proof, not a
sample; the lower end is a value that was met.
"""

import heapq
import itertools
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import sympy as sp
from sympy.printing.pycode import PythonCodePrinter

from ftc_jsb.theory.system import Range

METHODS = {
    sp.sin: "sin", sp.cos: "cos", sp.tan: "tan", sp.exp: "exp", sp.log: "log", sp.sinh: "sinh",
    sp.cosh: "cosh", sp.tanh: "tanh", sp.atan: "atan", sp.asin: "asin", sp.acos: "acos",
}  # fmt: skip
TOLERANCE = 0.01  # how far apart the ends may be, relative
SPLITS = 1000  # bisections after which the ends stay as far apart as they are
CORNERS = 10  # dimensions up to which every corner is tried first


class Enclosure(NamedTuple):
    """A supremum lies between these."""

    least: float  # met at a point
    most: float  # proven; inf where no proof could be had

    @property
    def certified(self) -> bool:
        """Whether there is an upper end."""
        return bool(np.isfinite(self.most))

    def __str__(self) -> str:
        """The interval, or `at least`."""
        if not self.certified:
            return f"at least {self.least:.4g}"
        if self.most <= self.least * (1.0 + 1e-9):
            return f"{self.most:.4g}"
        return f"{self.least:.4g} to {self.most:.4g}"


def largest(matrix: sp.Matrix, box: Mapping[sp.Symbol, Range]) -> Enclosure:
    """Supremum of the spectral norm of a matrix of expressions, or of the size of a single one.

    Args:
        matrix: expressions in symbols of the box.
        box: where they lie; a range of no width is a constant.
    """
    constants = {symbol: low for symbol, (low, high) in box.items() if low == high}
    exact = sp.ImmutableMatrix(matrix)
    free = sorted(exact.free_symbols - constants.keys(), key=str)
    known = sorted(exact.free_symbols & constants.keys(), key=str)
    evaluate = _compiled(exact, (*free, *known))
    if evaluate is None:
        return Enclosure(_largest_met(exact, free, {**box}), np.inf)
    values = [constants[symbol] for symbol in known]
    low = np.array([box[symbol][0] for symbol in free])
    high = np.array([box[symbol][1] for symbol in free])
    return _bisect(_Norm(evaluate, values, exact.shape), low, high)


class _Norm:
    """Value at a point, and upper bound over a box, of the norm of a matrix."""

    def __init__(
        self, evaluate: Callable[..., Any], constants: Sequence[float], shape: Any
    ) -> None:
        self._evaluate, self._shape = evaluate, shape
        self._constants = [_ball(value, value) for value in constants]

    def above(self, low: Any, high: Any) -> float:
        """Upper bound over a box: the norm at the centres of the balls plus that of their radii."""
        with np.errstate(invalid="ignore"):
            found = self._evaluate(*map(_ball, low, high), *self._constants)
        middle, radius = np.empty(len(found)), np.empty(len(found))
        for place, ball in enumerate(found):
            if isinstance(ball, int):
                middle[place], radius[place] = ball, 0.0
                continue
            if not ball.is_finite():
                return float(np.inf)
            centre = float(ball.mid())
            middle[place] = centre
            radius[place] = float(ball.rad()) + 1e-15 * abs(centre)
        norm = np.linalg.norm(middle.reshape(self._shape), 2)
        return float((norm + np.linalg.norm(radius)) * (1.0 + 1e-12))

    def at(self, point: Any) -> float:
        """A lower bound of the supremum: the norm at a point."""
        value = self.above(point, point)
        return value * (1.0 - 3e-12) if np.isfinite(value) else 0.0


def _bisect(norm: _Norm, low: Any, high: Any) -> Enclosure:
    """Split the box that may hold the most, where it helps the most, until the ends have met."""
    size = len(low)
    met = norm.at((low + high) / 2.0)
    if size <= CORNERS:
        met = max(
            [met, *(norm.at(corner) for corner in itertools.product(*zip(low, high, strict=True)))]
        )
    number = itertools.count()
    waiting = [(-norm.above(low, high), next(number), low, high)]
    for _ in range(SPLITS):
        if -waiting[0][0] <= met * (1.0 + TOLERANCE) or size == 0:
            break
        _, _, low, high = heapq.heappop(waiting)
        halves = min(
            (_halves(norm, low, high, axis) for axis in range(size)),
            key=lambda pair: (max(pair[0][0], pair[1][0]), sum(part[0] for part in pair)),
        )
        for above, left, right in halves:
            met = max(met, norm.at((left + right) / 2.0))
            heapq.heappush(waiting, (-above, next(number), left, right))
    return Enclosure(min(met, -waiting[0][0]), -waiting[0][0])


def _halves(norm: _Norm, low: Any, high: Any, axis: int) -> list[tuple[float, Any, Any]]:
    middle = (low[axis] + high[axis]) / 2.0
    upper, lower = high.copy(), low.copy()
    upper[axis] = lower[axis] = middle
    return [(norm.above(a, b), a, b) for a, b in ((low, upper), (lower, high))]


def _ball(low: float, high: float) -> Any:
    from flint import arb

    return arb(float(low)).union(arb(float(high)))


def _largest_met(matrix: sp.Matrix, free: list[sp.Symbol], box: dict[sp.Symbol, Range]) -> float:
    """Largest norm at 4096 Sobol points and at the middle: for expressions that arb does not know."""
    from scipy.stats import qmc

    constants = {symbol: low for symbol, (low, high) in box.items() if low == high}
    function = sp.lambdify(free, matrix.subs(constants), ["numpy", "scipy"])
    if not free:
        return float(np.linalg.norm(np.atleast_2d(function()), 2))
    low, high = (np.array([box[symbol][end] for symbol in free]) for end in (0, 1))
    unit = qmc.Sobol(len(free), seed=0).random(4096)
    sizes = [
        np.linalg.norm(np.array(function(*(low + row * (high - low))), dtype=float), 2)
        for row in unit
    ]
    return float(np.nanmax(sizes))


class _Unknown(Exception):  # noqa: N818
    """A function that arb has not."""


class _Printer(PythonCodePrinter):  # type: ignore[misc]
    """SymPy to Python on balls."""

    def _print_Rational(self, expr: Any) -> str:  # noqa: N802
        return f"(arb({expr.p})/{expr.q})"

    def _print_Float(self, expr: Any) -> str:  # noqa: N802
        return f"arb({float(expr)!r})"

    def _print_Pi(self, expr: Any) -> str:  # noqa: N802
        return "arb.pi()"

    def _print_Exp1(self, expr: Any) -> str:  # noqa: N802
        return "arb.const_e()"

    def _print_Abs(self, expr: Any) -> str:  # noqa: N802
        return f"abs({self._print(expr.args[0])})"

    def _print_Pow(self, expr: Any, rational: bool = False) -> str:  # noqa: N802
        base = f"({self._print(expr.base)})"
        if expr.exp == sp.Rational(1, 2):
            return f"{base}.sqrt()"
        if expr.exp == -sp.Rational(1, 2):
            return f"(1/{base}.sqrt())"
        if expr.exp.is_Integer:
            power = f"power({base}, {abs(int(expr.exp))})"
            return power if expr.exp > 0 else f"(1/{power})"
        return f"({base}**{self._print(expr.exp)})"

    def _print_Function(self, expr: Any) -> str:  # noqa: N802
        if expr.func not in METHODS or len(expr.args) != 1:
            raise _Unknown(str(expr.func))
        return f"({self._print(expr.args[0])}).{METHODS[expr.func]}()"

    def emptyPrinter(self, expr: Any) -> str:  # noqa: N802
        """Whatever this class says nothing about."""
        raise _Unknown(str(expr))


for _function in METHODS:
    setattr(_Printer, f"_print_{_function.__name__}", _Printer._print_Function)


def _power(ball: Any, exponent: int) -> Any:
    """A natural power, which arb's own is not for balls around zero; an even one is not negative."""
    result = ball
    for _ in range(exponent - 1):
        result = result * ball
    return result if exponent % 2 or isinstance(ball, int) else result.nonnegative_part()


def _compiled(matrix: sp.Matrix, symbols: Sequence[sp.Symbol]) -> Callable[..., Any] | None:
    """The elements of a matrix as a function of balls; None if arb cannot evaluate it."""
    from flint import arb

    plain = {symbol: sp.Symbol(f"x{i}_", real=True) for i, symbol in enumerate(symbols)}
    shared, reduced = sp.cse(list(matrix.xreplace(plain)))
    printer = _Printer({"fully_qualified_modules": False})
    try:
        lines = [f"    {symbol} = {printer.doprint(value)}" for symbol, value in shared]
        results = ", ".join(printer.doprint(value) for value in reduced)
    except _Unknown:
        return None
    arguments = ", ".join(str(plain[symbol]) for symbol in symbols)
    text = "\n".join([f"def function({arguments}):", *lines, f"    return [{results}]"])
    scope: dict[str, Any] = {"arb": arb, "power": _power}
    exec(text, scope)
    function: Callable[..., Any] = scope["function"]
    return function
