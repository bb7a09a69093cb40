"""g_M of Assumption 2 and L_1, L_2 of Proposition 4 over a box, and where neither exists.

Over a convex set of inputs the Lipschitz constant L_1 of F is the largest norm of dF/du, and g is
dF/du: both constants of (8) are one number. The remainder itself is of second order,
||O|| <= M/2 ||u - u_n||^2 with M the largest norm of the second derivative (Taylor).
"""

from collections.abc import Mapping
from typing import NamedTuple

import sympy as sp

from ftc_jsb.theory.enclosure import Enclosure, largest
from ftc_jsb.theory.system import System


class Bounds(NamedTuple):
    """Constants over the ranges of a system; of every channel's effectiveness, too."""

    gain: Enclosure  # g_M of Assumption 2
    lipschitz: Enclosure  # L_1 of (8)
    remainder: Enclosure  # L_2 = L_1 + g_M of (9)
    curvature: Enclosure  # M: ||O|| <= M/2 ||u - u_n||^2
    unbounded: tuple[str, ...]  # why Assumption 2 and Proposition 4 fail for inputs without limit


def bounds(system: System, units: Mapping[sp.Symbol, float] | None = None) -> Bounds:
    """The constants, enclosed.

    Args:
        system: with the ranges over which the constants are to hold.
        units: size of an input that counts as 1, such as 1e5 N; 1 for those not named.
    """
    units = units or {}
    inputs = list(system.inputs)
    scale = sp.diag(*[sp.nsimplify(units.get(symbol, 1.0), rational=True) for symbol in inputs])
    slope = system.faulty_dynamics.jacobian(inputs)
    box = box_of(system)
    gain = largest(slope * scale, box)
    columns = [
        (slope[:, place].jacobian(inputs) * scale * scale[place, place])
        for place in range(len(inputs))
    ]
    curvature = largest(sp.Matrix([list(sp.Matrix.hstack(*columns))]), box)  # Frobenius
    twice = Enclosure(2.0 * gain.least, 2.0 * gain.most)
    return Bounds(gain, gain, twice, curvature, unbounded(system))


def box_of(system: System) -> dict[sp.Symbol, tuple[float, float]]:
    """Where states, inputs, factors and parameters lie."""
    symbols = (*system.states, *system.inputs, *system.effectiveness)
    fixed = {symbol: (float(value), float(value)) for symbol, value in system.parameters.items()}
    return {**{symbol: system.range_of(symbol) for symbol in symbols}, **fixed}


def unbounded(system: System) -> tuple[str, ...]:
    """Elements of dF/du that grow without limit with an input, in words."""
    slope = system.faulty_dynamics.jacobian(list(system.inputs))
    found = []
    for row in range(slope.rows):
        for column, by in enumerate(system.inputs):
            element = slope[row, column]
            grows = [
                str(u) for u in system.inputs if u in element.free_symbols and _grows(element, u)
            ]
            if grows:
                rate = f"{system.states[row]}'"
                found.append(f"d({rate})/d{by} grows without limit with {', '.join(grows)}")
    return tuple(found)


def _grows(element: sp.Expr, symbol: sp.Symbol) -> bool:
    """Whether an expression is known to be unbounded in a symbol, the others at a general point.

    Only what is proven is said: a limit that SymPy cannot find, as of an oscillation, says nothing.
    """
    others = sorted(element.free_symbols - {symbol}, key=str)
    at = {other: sp.Rational(17 + 2 * i, 23) for i, other in enumerate(others)}
    line = sp.nsimplify(element, rational=True).subs(at)
    for end in (sp.oo, -sp.oo):
        try:
            limit = sp.limit(line, symbol, end)
        except (NotImplementedError, ValueError, TypeError):
            continue
        if limit.is_infinite:
            return True
    return False
