"""The affine approximation (4)-(6) at the trim input, and its remainder (7)."""

from typing import NamedTuple

import sympy as sp

from ftc_jsb.theory.system import Symbols, System


class Approximation(NamedTuple):
    """x' = f(x, u_n, k) + g(x, u_n, k) u + O(.): (4)-(6)."""

    trim: Symbols  # u_n
    f: sp.Matrix  # (states, 1)
    g: sp.Matrix  # (states, inputs)
    remainder: sp.Matrix  # (7) as printed, (states, 1)


def approximate(system: System) -> Approximation:
    """(4)-(6): g = dF/du at u_n, f = F(x, u_n, k) - g u_n; the leftover E(x) d of (6) is dropped."""
    trim = tuple(sp.Symbol(f"{symbol.name}_n", real=True) for symbol in system.inputs)
    at_trim = dict(zip(system.inputs, trim, strict=True))
    faulty = system.faulty_dynamics
    g = faulty.jacobian(list(system.inputs)).subs(at_trim, simultaneous=True)
    at = faulty.subs(at_trim, simultaneous=True)
    step = sp.Matrix(system.inputs) - sp.Matrix(trim)
    return Approximation(trim, at - g * sp.Matrix(trim), g, faulty - at - g * step)
