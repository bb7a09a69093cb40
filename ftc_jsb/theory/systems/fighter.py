"""The fighter (41)-(43), tracked by velocity as in the paper (index 1, 1, 1) or by position (2, 2, 2)."""

import numpy as np
import sympy as sp

from ftc_jsb.theory.case import TIME, Case
from ftc_jsb.theory.closed_loop import Settings
from ftc_jsb.theory.system import Expressions, Symbols, System

_V, _PATH, _HEADING = sp.symbols("V gamma chi", real=True)
_NORTH, _EAST, _ALTITUDE = sp.symbols("north east altitude", real=True)
_THRUST, _LOAD_FACTOR, _BANK = sp.symbols("T n bank", real=True)
_MASS, _G, _RHO, _S, _CD0, _CDK = sp.symbols("m g rho S C_D0 k_D", positive=True)

_PI = 3.141592653589793
_RANGES = {  # Omega_x: what the paper's flight needs, with room
    _V: (250.0, 340.0),
    _PATH: (-0.15, 0.15),
    _HEADING: (-_PI, _PI),
    _THRUST: (0.0, 113868.0),
    _LOAD_FACTOR: (0.5, 4.0),
    _BANK: (-1.4, 1.4),
}
_TABLE_1 = {_MASS: 14515.0, _G: 9.81, _RHO: 1.2251, _S: 37.16, _CD0: 0.02, _CDK: 0.1}


def _velocity_rates() -> Expressions:
    """(41) with the drag (43)."""
    weight = _MASS * _G
    pressure = _RHO * _V**2 * _S / 2
    drag = pressure * _CD0 + _CDK * _LOAD_FACTOR**2 * weight**2 / pressure
    return (
        _G * ((_THRUST - drag) / weight - sp.sin(_PATH)),
        _G / _V * (_LOAD_FACTOR * sp.cos(_BANK) - sp.cos(_PATH)),
        _G * _LOAD_FACTOR * sp.sin(_BANK) / (_V * sp.cos(_PATH)),
    )


def _position_rates() -> Expressions:
    """(42)."""
    return (
        _V * sp.cos(_PATH) * sp.cos(_HEADING),
        _V * sp.cos(_PATH) * sp.sin(_HEADING),
        _V * sp.sin(_PATH),
    )


def fighter_by_velocity() -> System:
    """The paper's example: x = y = [V, gamma, chi], u = [T, n, bank]."""
    states: Symbols = (_V, _PATH, _HEADING)
    inputs = (_THRUST, _LOAD_FACTOR, _BANK)
    return System(
        "fighter_by_velocity", states, inputs, _TABLE_1, _velocity_rates(), states, ranges=_RANGES
    )


def fighter_by_position() -> System:
    """Path tracking: x = [V, gamma, chi, north, east, altitude], y the position."""
    position: Symbols = (_NORTH, _EAST, _ALTITUDE)
    states = (_V, _PATH, _HEADING, *position)
    inputs = (_THRUST, _LOAD_FACTOR, _BANK)
    dynamics = (*_velocity_rates(), *_position_rates())
    reach = dict.fromkeys(position, (-20e3, 20e3))  # [m]
    return System(
        "fighter_by_position", states, inputs, _TABLE_1, dynamics, position,
        ranges={**_RANGES, **reach},
    )  # fmt: skip


def fighter_case() -> Case:
    """A weaving climb at 300 m/s with three estimated channels; from 20 s on 0.6 of the thrust is left."""
    degree = sp.pi / 180
    noise = np.array([1e-10] * 3 + [1e-8] * 3)
    return Case(
        "The paper's fighter by velocity, 0.6 of the thrust from 20 s on",
        fighter_by_velocity(),
        ((-1.0,),) * 3,
        (
            sp.Integer(300),
            3 * degree * sp.sin(TIME / 8) ** 2,
            30 * degree * sp.sin(TIME / 6),
        ),
        (300.0, 0.0, 0.0),
        (42e3, 2.8, 1.2),
        60.0,
        Settings(0.01, 50.0, noise, np.full(3, 1e-10), np.array([1e-6, 1e-8, 1e-8] + [1e-4] * 3)),
        {_THRUST: sp.Piecewise((1, TIME < 20), (sp.Rational(3, 5), True))},
    )
