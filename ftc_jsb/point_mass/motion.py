"""Flight of the point mass under held commands: (41)-(42), responses and spool by Runge-Kutta steps."""

import math
from typing import Any

import numpy as np

from ftc_jsb.compiled import compiled
from ftc_jsb.disturbance.wind import wind_step
from ftc_jsb.frames import attitude_from_path
from ftc_jsb.point_mass.dynamics import (
    derivatives,
    level_trim_thrust,
    load_factor_limit,
    polar_drag,
    velocity,
)
from ftc_jsb.point_mass.model import at_condition
from ftc_jsb.point_mass.thrust import healthy_thrust, next_rotor_speed, rotor_speed_target

POINT_MASS_STATE = np.dtype(
    [
        # airspeed, path, heading, north, east, altitude, load factor and its rate, bank and its rate
        ("x", float, (10,)),
        ("rotor_speed", float),
        ("thrust", float),  # delivered [N]
    ]
)


@compiled
def _rates(
    model: Any,
    x: Any,
    thrust: float,
    load_factor: float,
    bank: float,
    cb: float,
    sb: float,
    out: Any,
) -> None:
    """Derivative of the state `x` at a delivered thrust and effective commands, in still air.

    `cb` and `sb` are cosine and sine of the commanded bank, which acts where there is no lag.
    """
    at = at_condition(model, x[0], x[5])
    out[6], out[7] = 0.0, 0.0
    if model.response_frequency[0] > 0.0:
        frequency, damping = model.response_frequency[0], model.response_damping[0]
        out[6] = x[7]
        out[7] = frequency * (frequency * (load_factor - x[6]) - 2.0 * damping * x[7])
        load_factor = x[6]
    out[8], out[9] = 0.0, 0.0
    if model.response_frequency[1] > 0.0:
        frequency, damping = model.response_frequency[1], model.response_damping[1]
        out[8] = x[9]
        acceleration = frequency * (frequency * (bank - x[8]) - 2.0 * damping * x[9])
        if model.bank_acceleration_max > 0.0:
            most = model.bank_acceleration_max
            acceleration = min(max(acceleration, -most), most)
        out[9] = acceleration
        cb, sb = math.cos(x[8]), math.sin(x[8])
    out[0], out[1], out[2] = derivatives(at, x[0], x[1], thrust, load_factor, cb, sb)
    out[3], out[4], out[5] = velocity(x[0], x[1], x[2])


@compiled
def _runge_kutta(
    model: Any, wind: Any, x: Any, thrust: float, load_factor: float, bank: float, dt: float
) -> None:
    """One classical Runge-Kutta step of `dt` seconds, in place."""
    size = x.size
    k1, k2, k3, k4 = np.empty(size), np.empty(size), np.empty(size), np.empty(size)
    y = np.empty(size)
    cb, sb = math.cos(bank), math.sin(bank)
    _rates(model, x, thrust, load_factor, bank, cb, sb, k1)
    for a in range(size):
        y[a] = x[a] + 0.5 * dt * k1[a]
    _rates(model, y, thrust, load_factor, bank, cb, sb, k2)
    for a in range(size):
        y[a] = x[a] + 0.5 * dt * k2[a]
    _rates(model, y, thrust, load_factor, bank, cb, sb, k3)
    for a in range(size):
        y[a] = x[a] + dt * k3[a]
    _rates(model, y, thrust, load_factor, bank, cb, sb, k4)
    for a in range(size):
        x[a] += dt / 6.0 * (k1[a] + 2.0 * (k2[a] + k3[a]) + k4[a])
    if wind.still == 0:
        _blow(wind, x, dt)


@compiled
def _blow(wind: Any, x: Any, dt: float) -> None:
    """What wind adds over `dt` seconds: it carries the aircraft, and its change is felt as airspeed.

    The air-relative velocity is the inertial one less the wind, so that the wind's rate, along, up
    and across the path, goes into (41) with a minus sign. Lift and drag of the gust itself are
    those of the new airspeed; the load factor follows its command.
    """
    sg, cg, sh, ch = math.sin(x[1]), math.cos(x[1]), math.sin(x[2]), math.cos(x[2])
    north, east, up = wind.rate[0], wind.rate[1], wind.rate[2]
    level = north * ch + east * sh
    x[3] += dt * wind.now[0]
    x[4] += dt * wind.now[1]
    x[5] += dt * wind.now[2]
    x[1] -= dt * (up * cg - level * sg) / x[0]
    x[2] -= dt * (east * ch - north * sh) / (x[0] * cg)
    x[0] -= dt * (level * cg + up * sg)


@compiled
def point_mass_step(
    model: Any, wind: Any, state: Any, record: Any, i: int, dt: float, substeps: int
) -> None:
    """Fly the commands of row `i` for `dt` seconds through the wind of `wind_step`.

    Thrust, load factor and bank in force are written to row `i` where they act at once; the
    commands are held within the aircraft's limits, the effectiveness of row `i` multiplies them.
    """
    m, s, row = model[0], state[0], record[i]
    x = s.x
    at = at_condition(m, x[0], x[5])
    most = load_factor_limit(at, x[0], m.load_factor_max, m.lift_coefficient_max)
    load_factor = min(max(row.load_factor_cmd, m.load_factor_min), most)
    load_factor *= row.effectiveness_load_factor
    bank = row.bank_angle_cmd * row.effectiveness_bank_angle
    if m.response_frequency[0] == 0.0:
        x[6] = load_factor
        row.load_factor = load_factor
    if m.response_frequency[1] == 0.0:
        x[8] = bank
        row.bank_angle = bank
    for _ in range(substeps):
        at = at_condition(m, x[0], x[5])
        if m.spool_up[0] > 0.0:
            s.rotor_speed = next_rotor_speed(m, at, s.rotor_speed, row.thrust_cmd, dt / substeps)
            healthy = healthy_thrust(at, s.rotor_speed, row.thrust_cmd)
        else:
            healthy = min(max(row.thrust_cmd, at.thrust_idle), at.thrust_maximum)
        s.thrust = row.effectiveness_thrust * healthy
        _runge_kutta(m, wind[0], x, s.thrust, load_factor, bank, dt / substeps)
        if m.bank_rate_max > 0.0:
            x[9] = min(max(x[9], -m.bank_rate_max), m.bank_rate_max)
    if m.spool_up[0] == 0.0:
        row.thrust = s.thrust
        row.drag = polar_drag(at, row.airspeed, s.thrust, x[6])[0]


@compiled
def point_mass_truth(model: Any, wind: Any, state: Any, record: Any, i: int, dt: float) -> None:
    """Write the state of the aircraft and the wind to row `i`, and move the wind on.

    The attitude is that of flight without sideslip.
    """
    m, s, row = model[0], state[0], record[i]
    x = s.x
    at = at_condition(m, x[0], x[5])
    row.airspeed, row.flight_path_angle, row.heading = x[0], x[1], x[2]
    row.north, row.east, row.altitude = x[3], x[4], x[5]
    row.load_factor, row.bank_angle = x[6], x[8]
    row.thrust = s.thrust
    row.drag, row.alpha = polar_drag(at, x[0], s.thrust, x[6])
    row.sideslip = 0.0
    row.mach = x[0] / at.sound_speed
    row.mass = m.mass
    sa, ca = math.sin(row.alpha), math.cos(row.alpha)
    along = (s.thrust * ca - row.drag) / (m.mass * m.gravity)
    row.load_factor_x = along * ca + x[6] * sa
    row.load_factor_y = 0.0
    row.load_factor_z = x[6] * ca - along * sa
    row.roll, row.pitch, turn = attitude_from_path(x[1], x[8], row.alpha)
    row.yaw = x[2] + turn
    wind_step(wind, record, i, dt)
    row.wind_north, row.wind_east, row.wind_up = wind[0].now


@compiled
def trim_thrust(model: Any, airspeed: float, altitude: float, path: float) -> tuple[float, float]:
    """Thrust [N] of level trim within the engine's limits, and the rotor speed that gives it."""
    at = at_condition(model[0], airspeed, altitude)
    thrust = level_trim_thrust(at, airspeed, path)
    thrust = min(max(thrust, at.thrust_idle), at.thrust_maximum)
    return thrust, rotor_speed_target(at, thrust)
