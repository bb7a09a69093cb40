"""Whether a SymPy expression vanishes identically: by rewriting, then in numbers of fifty digits."""

from collections.abc import Callable, Iterator

import mpmath
import numpy as np
import sympy as sp

from ftc_jsb.theory.system import Range

PROBES = 7  # random points at which an expression must vanish before it is called zero
DIGITS = 50
ROUNDING = 1e-30  # of the size of an expression's terms: what fifty digits leave of a true zero
RangeOf = Callable[[sp.Symbol], Range]


def is_zero(expression: sp.Expr, range_of: RangeOf, seed: int = 0) -> bool:
    """Whether an expression vanishes identically.

    Decimals are taken for the fractions that they are written as. What expansion does not reduce to
    zero is evaluated at random points with fifty digits and compared with the size of its own
    terms: a factor of 1e-10 that is meant is no zero, and a cancellation is one.

    Args:
        expression: of symbols that `range_of` knows.
        range_of: where each symbol lies.
        seed: of the points.
    """
    exact = sp.expand(sp.nsimplify(expression, rational=True))
    if exact == 0:
        return True
    symbols = sorted(exact.free_symbols, key=str)
    terms = sp.Add.make_args(exact)
    evaluate = sp.lambdify(symbols, list(terms), "mpmath")
    seen = 0
    with mpmath.workdps(DIGITS):
        for point in points(symbols, range_of, seed):
            try:
                values = evaluate(*point)
            except (ZeroDivisionError, ValueError):
                continue
            size = sum(abs(value) for value in values)
            if not mpmath.isfinite(size):
                continue
            seen += 1
            if abs(sum(values)) > ROUNDING * size:
                return False
    return seen > 0 or sp.simplify(exact) == 0


def points(symbols: list[sp.Symbol], range_of: RangeOf, seed: int) -> Iterator[list[mpmath.mpf]]:
    """Random points inside the ranges."""
    random = np.random.default_rng(seed)
    for _ in range(PROBES):
        point = []
        for symbol in symbols:
            low, high = range_of(symbol)
            point.append(mpmath.mpf(low) + mpmath.mpf(random.random()) * (mpmath.mpf(high) - low))
        yield point


def generic_rank(matrix: sp.Matrix, range_of: RangeOf, seed: int = 0) -> int:
    """Largest rank that a matrix of expressions has at random points; that is its rank almost everywhere."""
    exact = matrix.applyfunc(lambda element: sp.nsimplify(element, rational=True))
    symbols = sorted(exact.free_symbols, key=str)
    evaluate = sp.lambdify(symbols, exact.tolist(), "mpmath")
    rank = 0
    with mpmath.workdps(DIGITS):
        for point in points(symbols, range_of, seed):
            try:
                rank = max(rank, _rank(evaluate(*point)))
            except (ZeroDivisionError, ValueError):
                continue
    return rank


def _rank(rows: list[list[mpmath.mpf]]) -> int:
    """By elimination with full pivoting; a pivot counts relative to its row's size before."""
    left = [[mpmath.mpf(value) for value in row] for row in rows]
    left = [[value / max(map(abs, row)) for value in row] for row in left if any(row)]
    rank = 0
    while left:
        size, row, column = max(
            (abs(value), i, j) for i, line in enumerate(left) for j, value in enumerate(line)
        )
        if not size > ROUNDING:
            break
        rank += 1
        pivot = left.pop(row)
        left = [
            [value - line[column] / pivot[column] * p for value, p in zip(line, pivot, strict=True)]
            for line in left
        ]
    return rank
