"""A nonaffine plant of index 2 that the literature on the subject uses, with a loss of effectiveness."""

import sympy as sp

from ftc_jsb.theory.system import System


def textbook_plant() -> System:
    """x1' = x2, x2' = x1^2 + 0.15 u^3 + 0.1 (1 + x2^2) u + sin(0.1 u), y = x1; u efficacious."""
    x1, x2, u = sp.symbols("x1 x2 u", real=True)
    tenth = sp.Rational(1, 10)
    rate = x1**2 + sp.Rational(15, 100) * u**3 + tenth * (1 + x2**2) * u + sp.sin(tenth * u)
    ranges = {u: (-2.0, 2.0)}
    return System("textbook_plant", (x1, x2), (u,), {}, (x2, rate), (x1,), ranges=ranges)
