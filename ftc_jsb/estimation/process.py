"""The process model f of (21) that every filter shares: (41) over one sample, faults constant.

Filter state: [airspeed, flight path angle, heading, effectiveness of the estimated channels].
"""

import math
from typing import Any, NamedTuple

import numpy as np

from ftc_jsb.compiled import compiled
from ftc_jsb.point_mass.dynamics import derivatives, path_rates
from ftc_jsb.point_mass.model import Condition

OUTPUTS = 3  # airspeed, flight path angle, heading: the measurement (21), y = h(x)
CHANNELS = 3  # thrust, load factor, bank angle
STATES = OUTPUTS + CHANNELS  # capacity; `count` of them are in use

FILTER = np.dtype(
    [
        ("count", np.int64),  # states in use: 3 + estimated channels
        ("channel", np.int64, (CHANNELS,)),  # channel of each effectiveness state
        ("estimate", float, (STATES,)),
        ("covariance", float, (STATES, STATES)),
        ("factor", float, (STATES, STATES)),  # scratch
        ("points", float, (2 * STATES + 1, STATES)),  # scratch
        ("gain", float, (STATES, OUTPUTS)),
        ("innovation", float, (OUTPUTS,)),
        ("innovation_covariance", float, (OUTPUTS, OUTPUTS)),
        ("nis", float),  # normalised innovation squared
        ("rejected", np.int64),  # samples in a row that the gate has refused
    ]
)


class Forcing(NamedTuple):
    """What acts on the aircraft over one sample, as the filter knows it."""

    thrust: float  # of a healthy engine [N]
    load_factor: float
    bank_angle: float  # [rad]
    measured_drag: bool  # drag and alpha below are measured; otherwise the polar gives them
    drag_coefficient: float
    alpha: float  # [rad]


@compiled
def _rates(
    at: Condition,
    forcing: Forcing,
    airspeed: float,
    flight_path_angle: float,
    thrust: float,
    load_factor: float,
    cos_bank: float,
    sin_bank: float,
) -> tuple[float, float, float]:
    """(41); `thrust` is along the path where drag is measured, along the body where it is not."""
    if forcing.measured_drag:
        drag = 0.5 * at.density * airspeed * airspeed * at.area * forcing.drag_coefficient
        force = thrust - drag
        return path_rates(at, airspeed, flight_path_angle, force, load_factor, cos_bank, sin_bank)
    return derivatives(at, airspeed, flight_path_angle, thrust, load_factor, cos_bank, sin_bank)


@compiled
def propagate(at: Condition, forcing: Forcing, filter_state: Any, point: Any, dt: float) -> None:
    """F of (21) and (27), in place: one classical Runge-Kutta step of (41) over `dt` seconds.

    Args:
        at: the model at the sample's flight condition.
        forcing: held over the sample.
        filter_state: FILTER record; tells which channel each effectiveness state belongs to.
        point: (STATES,), a filter state; its first three elements are advanced.
        dt: sample time [s].
    """
    thrust = forcing.thrust
    load_factor = forcing.load_factor
    bank_angle = forcing.bank_angle
    for i in range(OUTPUTS, filter_state.count):
        channel = filter_state.channel[i - OUTPUTS]
        if channel == 0:
            thrust *= point[i]
        elif channel == 1:
            load_factor *= point[i]
        else:
            bank_angle *= point[i]
    if forcing.measured_drag:
        thrust *= math.cos(forcing.alpha)
    cb, sb = math.cos(bank_angle), math.sin(bank_angle)
    v, p, h = point[0], point[1], point[2]
    half = 0.5 * dt
    a1, b1, c1 = _rates(at, forcing, v, p, thrust, load_factor, cb, sb)
    a2, b2, c2 = _rates(at, forcing, v + half * a1, p + half * b1, thrust, load_factor, cb, sb)
    a3, b3, c3 = _rates(at, forcing, v + half * a2, p + half * b2, thrust, load_factor, cb, sb)
    a4, b4, c4 = _rates(at, forcing, v + dt * a3, p + dt * b3, thrust, load_factor, cb, sb)
    point[0] = v + dt / 6.0 * (a1 + 2.0 * (a2 + a3) + a4)
    point[1] = p + dt / 6.0 * (b1 + 2.0 * (b2 + b3) + b4)
    point[2] = h + dt / 6.0 * (c1 + 2.0 * (c2 + c3) + c4)
