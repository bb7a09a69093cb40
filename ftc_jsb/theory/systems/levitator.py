"""A magnetic levitator: the force goes with the square of current over gap."""

import numpy as np
import sympy as sp

from ftc_jsb.theory.case import TIME, Case
from ftc_jsb.theory.closed_loop import Settings
from ftc_jsb.theory.system import System

_GAP, _SPEED, _CURRENT = sp.symbols("gap speed current", real=True)
_MASS, _G, _COIL = sp.symbols("m g C", positive=True)


def levitator() -> System:
    """Gap'' = g - C / m (i / gap)^2, y = gap; index 2. G vanishes without a current."""
    rates = (_SPEED, _G - _COIL / _MASS * (_CURRENT / _GAP) ** 2)
    parameters = {_MASS: 0.068, _G: 9.80665, _COIL: 6.53e-5}  # kg, m/s2, N m2/A2
    ranges = {_GAP: (0.006, 0.014), _SPEED: (-0.05, 0.05), _CURRENT: (0.3, 3.0)}  # m, m/s, A
    return System(
        "levitator", (_GAP, _SPEED), (_CURRENT,), parameters, rates, (_GAP,), ranges=ranges
    )


def levitator_case() -> Case:
    """The gap swings by 2 mm; from 3 s on the coil gives three quarters of its field."""
    return Case(
        "Magnetic levitator, 0.75 of the current from 3 s on",
        levitator(),
        ((-20.0, -30.0),),
        (sp.Rational(1, 100) + sp.sin(2 * TIME) / 500,),
        (0.010, 0.004),
        (1.0106,),
        6.0,
        Settings(
            0.001, 200.0, np.array([1e-14, 1e-10, 1e-6]), np.array([1e-12]),
            np.array([1e-12, 1e-8, 1e-4]),
        ),
        {_CURRENT: sp.Piecewise((1, TIME < 3), (sp.Rational(3, 4), True))},
    )  # fmt: skip
