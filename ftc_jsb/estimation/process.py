"""The process model f of (21) that every filter shares: (41) over one sample, faults constant.

Filter state: [airspeed, flight path angle, heading, effectiveness of the estimated channels].
"""

import math
from typing import NamedTuple

import numpy as np

from ftc_jsb.compiled import compiled, inlined
from ftc_jsb.point_mass.dynamics import derivatives, path_rates
from ftc_jsb.point_mass.model import Condition, pressure_area
from ftc_jsb.trigonometry import turned
from ftc_jsb.vocabulary.channels import CHANNELS
from ftc_jsb.vocabulary.kernel_types import Filter

OUTPUTS = 3  # airspeed, flight path angle, heading: the measurement (21), y = h(x)
STATES = OUTPUTS + len(CHANNELS)  # capacity; `count` of them are in use

POINTS = 2 * STATES + 1

STAGES = np.dtype(  # of a Runge-Kutta step, for each point
    [
        ("thrust", float, (POINTS,)),  # [N], along the path where drag is measured
        ("load_factor", float, (POINTS,)),
        ("cos_bank", float, (POINTS,)),
        ("sin_bank", float, (POINTS,)),
        ("cos_path", float, (POINTS,)),  # at its start
        ("sin_path", float, (POINTS,)),
        ("rate", float, (2, POINTS)),  # of airspeed and flight path angle, at the stage before
        ("total", float, (OUTPUTS, POINTS)),  # of the weighted rates
    ]
)

FILTER = np.dtype(
    [
        ("count", np.int64),  # states in use: 3 + estimated channels
        ("channel", np.int64, (len(CHANNELS),)),  # channel of each effectiveness state
        ("estimate", float, (STATES,)),
        ("covariance", float, (STATES, STATES)),
        ("factor", float, (STATES, STATES)),  # scratch
        ("points", float, (POINTS, STATES)),  # scratch
        ("stages", STAGES),  # scratch
        ("gain", float, (STATES, OUTPUTS)),
        ("innovation", float, (OUTPUTS,)),
        ("innovation_covariance", float, (OUTPUTS, OUTPUTS)),
        ("nis", float),  # normalised innovation squared
        ("rejected", np.int64),  # samples in a row that the gate has refused
    ]
)


@compiled
def place_of_channel(filter_state: Filter, channel: int) -> int:
    """Place of a channel's effectiveness in the state of a filter; -1 where it is not estimated."""
    for a in range(filter_state.count - OUTPUTS):
        if filter_state.channel[a] == channel:
            return OUTPUTS + a
    return -1


class Forcing(NamedTuple):
    """What acts on the aircraft over one sample, as the filter knows it."""

    thrust: float  # of a healthy engine [N]
    load_factor: float
    bank_angle: float  # [rad]
    measured_drag: bool  # drag and alpha below are measured; otherwise the polar gives them
    drag_coefficient: float
    alpha: float  # [rad]


@inlined
def _rates(
    at: Condition,
    forcing: Forcing,
    airspeed: float,
    cos_path: float,
    sin_path: float,
    thrust: float,
    load_factor: float,
    bank: tuple[float, float],
) -> tuple[float, float, float]:
    """(41), bank as cosine and sine.

    `thrust` is along the path where drag is measured, along the body where it is not.
    """
    cos_bank, sin_bank = bank
    if forcing.measured_drag:
        drag = pressure_area(at, airspeed) * forcing.drag_coefficient
        force = thrust - drag
        return path_rates(at, airspeed, cos_path, sin_path, force, load_factor, cos_bank, sin_bank)
    return derivatives(at, airspeed, cos_path, sin_path, thrust, load_factor, cos_bank, sin_bank)


class Axes(NamedTuple):
    """Cosines and sines of the directions near which all points of one sample lie."""

    path: float  # [rad]
    cos_path: float
    sin_path: float
    cos_bank: float
    sin_bank: float
    cos_alpha: float


@compiled
def axes(forcing: Forcing, flight_path_angle: float) -> Axes:
    """Axes at a flight path angle [rad] and at the bank and alpha of `forcing`."""
    return Axes(
        flight_path_angle,
        math.cos(flight_path_angle),
        math.sin(flight_path_angle),
        math.cos(forcing.bank_angle),
        math.sin(forcing.bank_angle),
        math.cos(forcing.alpha),
    )


@compiled
def propagate(
    at: Condition, forcing: Forcing, near: Axes, filter_state: Filter, count: int, dt: float
) -> None:
    """F of (21) and (27): one classical Runge-Kutta step of (41) over `dt` seconds, of many points.

    All points go through a stage before any goes on to the next: their rates do not wait for one
    another, and a processor works on several at a time.

    Args:
        at: the model at the sample's flight condition.
        forcing: held over the sample.
        near: `axes` of the forcing at a flight path angle near those of the points.
        filter_state: FILTER record; its first `count` points, each a filter state, are advanced.
        count: of points.
        dt: sample time [s].
    """
    points, w = filter_state.points, filter_state.stages
    for k in range(count):
        thrust, load_factor = forcing.thrust, forcing.load_factor
        cb, sb = near.cos_bank, near.sin_bank
        for i in range(OUTPUTS, filter_state.count):
            channel = filter_state.channel[i - OUTPUTS]
            if channel == 0:
                thrust *= points[k, i]
            elif channel == 1:
                load_factor *= points[k, i]
            else:
                cb, sb = turned(cb, sb, (points[k, i] - 1.0) * forcing.bank_angle)
        w.thrust[k] = thrust * near.cos_alpha if forcing.measured_drag else thrust
        w.load_factor[k], w.cos_bank[k], w.sin_bank[k] = load_factor, cb, sb
        cp, sp = turned(near.cos_path, near.sin_path, points[k, 1] - near.path)
        w.cos_path[k], w.sin_path[k] = cp, sp
        w.rate[0, k], w.rate[1, k] = 0.0, 0.0
        for a in range(OUTPUTS):
            w.total[a, k] = 0.0
    for stage in range(4):
        ahead = 0.0 if stage == 0 else dt if stage == 3 else 0.5 * dt
        weight = 1.0 if stage == 0 or stage == 3 else 2.0
        for k in range(count):
            cp, sp = turned(w.cos_path[k], w.sin_path[k], ahead * w.rate[1, k])
            airspeed = points[k, 0] + ahead * w.rate[0, k]
            rates = _rates(
                at,
                forcing,
                airspeed,
                cp,
                sp,
                w.thrust[k],
                w.load_factor[k],
                (w.cos_bank[k], w.sin_bank[k]),
            )
            w.rate[0, k], w.rate[1, k] = rates[0], rates[1]
            for a in range(OUTPUTS):
                w.total[a, k] += weight * rates[a]
    for k in range(count):
        for a in range(OUTPUTS):
            points[k, a] += dt / 6.0 * w.total[a, k]
