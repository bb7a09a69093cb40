"""A stirred tank reactor cooled by a flow that acts through an exponential: a benchmark of the field."""

import numpy as np
import sympy as sp

from ftc_jsb.theory.case import TIME, Case
from ftc_jsb.theory.closed_loop import Settings
from ftc_jsb.theory.system import System

_CONCENTRATION, _TEMPERATURE, _COOLANT = sp.symbols("C_a T q_c", real=True)
_Q, _VOLUME, _FEED, _T_FEED, _T_COOLANT, _A0, _A1, _A2, _A3, _E = sp.symbols(
    "q V C_a0 T_f T_cf a_0 a_1 a_2 a_3 E_R", positive=True
)
_VALUES = {
    _Q: 100.0,  # l/min
    _VOLUME: 100.0,  # l
    _FEED: 1.0,  # mol/l
    _T_FEED: 350.0,  # K
    _T_COOLANT: 350.0,  # K
    _A0: 7.2e10,  # 1/min
    _A1: 1.44e13,  # K l/(min mol)
    _A2: 6.987e2,  # l/min
    _A3: 0.01,  # 1/l
    _E: 1e4,  # K
}


def reactor() -> System:
    """C_a by the coolant flow q_c, index 2 (Ge, Hang and Zhang, IEEE Trans. Neural Networks 10, 1999).

    Both states are measured; the effectiveness is that of the coolant's valve.
    """
    reaction = _CONCENTRATION * sp.exp(-_E / _TEMPERATURE)
    rates = (
        _Q / _VOLUME * (_FEED - _CONCENTRATION) - _A0 * reaction,
        _Q / _VOLUME * (_T_FEED - _TEMPERATURE)
        + _A1 * reaction
        + _A3 * _COOLANT * (1 - sp.exp(-_A2 / _COOLANT)) * (_T_COOLANT - _TEMPERATURE),
    )
    states = (_CONCENTRATION, _TEMPERATURE)
    ranges = {_CONCENTRATION: (0.06, 0.14), _TEMPERATURE: (430.0, 448.0), _COOLANT: (60.0, 180.0)}
    return System(
        "reactor", states, (_COOLANT,), _VALUES, rates, (_CONCENTRATION,), states, ranges=ranges
    )


def reactor_case() -> Case:
    """C_a swings by 0.01 mol/l about 0.1; from 6 min on the valve gives 0.8 of the flow."""
    return Case(
        "Stirred tank reactor, 0.8 of the coolant from 6 min on",
        reactor(),
        ((-3.0, -4.0),),
        (sp.Rational(1, 10) + sp.sin(TIME) / 100,),
        (0.1, 438.54),
        (103.41,),
        12.0,
        Settings(
            0.005, 50.0, np.array([1e-12, 1e-6, 1e-6]), np.array([1e-10, 1e-6]),
            np.array([1e-10, 1e-6, 1e-4]),
        ),
        {_COOLANT: sp.Piecewise((1, TIME < 6), (sp.Rational(4, 5), True))},
        time_unit="min",
    )  # fmt: skip
