"""A nonaffine plant of index 2 that the literature on the subject uses, with a loss of effectiveness."""

import numpy as np
import sympy as sp

from ftc_jsb.theory.case import TIME, Case
from ftc_jsb.theory.closed_loop import Settings
from ftc_jsb.theory.system import System


def textbook_plant() -> System:
    """x1' = x2, x2' = x1^2 + 0.15 u^3 + 0.1 (1 + x2^2) u + sin(0.1 u), y = x1; u efficacious."""
    x1, x2, u = sp.symbols("x1 x2 u", real=True)
    tenth = sp.Rational(1, 10)
    rate = x1**2 + sp.Rational(15, 100) * u**3 + tenth * (1 + x2**2) * u + sp.sin(tenth * u)
    ranges = {u: (-2.0, 2.0)}
    return System("textbook_plant", (x1, x2), (u,), {}, (x2, rate), (x1,), ranges=ranges)


def textbook_case() -> Case:
    """x1 follows a sine; from 5 s on 0.8 of the input is left."""
    system = textbook_plant()
    return Case(
        "Textbook plant, 0.8 of the input from 5 s on",
        system,
        ((-2.0, -3.0),),
        (sp.sin(TIME) / 2,),
        (0.0, 0.5),
        (0.0,),
        20.0,
        Settings(
            0.005, 50.0, np.array([1e-10, 1e-10, 1e-6]), np.array([1e-8]),
            np.array([1e-6, 1e-6, 1e-4]),
        ),
        {system.inputs[0]: sp.Piecewise((1, TIME < 5), (sp.Rational(4, 5), True))},
    )  # fmt: skip
