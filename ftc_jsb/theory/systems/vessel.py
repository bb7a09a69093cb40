"""A vessel with an azimuth thruster astern and a tunnel thruster ahead: six states, three losses."""

import numpy as np
import sympy as sp

from ftc_jsb.theory.case import TIME, Case
from ftc_jsb.theory.closed_loop import Settings
from ftc_jsb.theory.system import System

_NORTH, _EAST, _YAW, _SURGE, _SWAY, _TURN = sp.symbols("north east yaw surge sway turn", real=True)
_THRUST, _AZIMUTH, _TUNNEL = sp.symbols("thrust azimuth tunnel", real=True)
_M1, _M2, _M3, _D1, _D2, _D3, _ASTERN, _AHEAD = sp.symbols(
    "m_surge m_sway m_yaw d_surge d_sway d_yaw l_astern l_ahead", positive=True
)
_SIZE = {  # of a model of 1:70: kg, kg, kg m2, kg/s, kg/s, kg m2/s, m, m
    _M1: 25.8, _M2: 33.8, _M3: 2.76, _D1: 2.0, _D2: 7.0, _D3: 1.9, _ASTERN: 0.4, _AHEAD: 0.4,
}  # fmt: skip


def vessel() -> System:
    """Manoeuvring in the plane (Fossen 2011, ch. 6) with diagonal mass and damping; y = position and
    yaw, index (2, 2, 2). G has no pivot for the azimuth without thrust.
    """
    along = _THRUST * sp.cos(_AZIMUTH)
    aside = _THRUST * sp.sin(_AZIMUTH)
    rates = (
        _SURGE * sp.cos(_YAW) - _SWAY * sp.sin(_YAW),
        _SURGE * sp.sin(_YAW) + _SWAY * sp.cos(_YAW),
        _TURN,
        (along + _M2 * _SWAY * _TURN - _D1 * _SURGE) / _M1,
        (aside + _TUNNEL - _M1 * _SURGE * _TURN - _D2 * _SWAY) / _M2,
        (_AHEAD * _TUNNEL - _ASTERN * aside + (_M1 - _M2) * _SURGE * _SWAY - _D3 * _TURN) / _M3,
    )
    states = (_NORTH, _EAST, _YAW, _SURGE, _SWAY, _TURN)
    ranges = {
        _NORTH: (-40.0, 40.0), _EAST: (-40.0, 40.0), _YAW: (-0.5, 3.7), _SURGE: (0.2, 0.8),
        _SWAY: (-0.3, 0.3), _TURN: (-0.3, 0.3), _THRUST: (0.4, 6.0), _AZIMUTH: (-1.4, 1.4),
        _TUNNEL: (-4.0, 4.0),
    }  # fmt: skip
    return System(
        "vessel", states, (_THRUST, _AZIMUTH, _TUNNEL), _SIZE, rates, states[:3], ranges=ranges
    )


def vessel_case() -> Case:
    """A circle of 10 m at 0.5 m/s, nose along it; thrust, azimuth and tunnel lose one after another."""
    angle = TIME / 20
    losses = {_THRUST: (15, 0.7), _AZIMUTH: (30, 0.8), _TUNNEL: (45, 0.6)}
    noise = np.array([1e-10] * 6 + [1e-7] * 3)
    return Case(
        "Vessel on a circle: losses of thrust at 15 s, azimuth at 30 s, tunnel at 45 s",
        vessel(),
        ((-0.5, -0.8),) * 3,
        (10 * sp.sin(angle), 10 * (1 - sp.cos(angle)), angle + sp.sin(TIME / 4) / 5),
        (0.0, 0.0, 0.0, 0.5, 0.0, 0.1),
        (1.1, 0.2, 0.4),
        60.0,
        Settings(0.02, 25.0, noise, np.full(3, 1e-8), np.array([1e-8] * 6 + [1e-4] * 3)),
        {
            symbol: sp.Piecewise((1, start > TIME), (factor, True))
            for symbol, (start, factor) in losses.items()
        },
    )
