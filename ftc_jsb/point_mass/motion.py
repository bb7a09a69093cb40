"""Flight of the point mass under held commands: (41)-(42), responses and spool by Runge-Kutta steps."""

import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled
from ftc_jsb.disturbance.wind import wind_step
from ftc_jsb.frames import attitude_from_path
from ftc_jsb.point_mass.dynamics import (
    derivatives,
    level_trim_thrust,
    load_factor_limit,
    polar_drag,
)
from ftc_jsb.point_mass.fuel import burn_fuel, fuel_on_board
from ftc_jsb.point_mass.model import at_condition
from ftc_jsb.point_mass.response import lag_acceleration
from ftc_jsb.point_mass.thrust import healthy_thrust, next_rotor_speed, rotor_speed_target
from ftc_jsb.trigonometry import turned
from ftc_jsb.vocabulary.kernel_types import ModelRecord, Records, Vector, WindRecord

STATES = 10
ANGLES = np.dtype(
    [
        (f"{what}{angle}", float)
        for angle in ("path", "heading", "bank")
        for what in ("", "cos_", "sin_")
    ]
)
POINT_MASS_STATE = np.dtype(
    [
        # airspeed, path, heading, north, east, altitude, load factor and its rate, bank and its rate
        ("x", float, (STATES,)),
        ("rotor_speed", float),
        ("thrust", float),  # delivered [N]
        ("fuel_flow", float),  # [kg/s]
        ("y", float, (STATES,)),  # scratch: state at a stage of the Runge-Kutta step
        ("k", float, (4, STATES)),  # scratch: rates of its stages
        ("start", ANGLES),  # scratch: angles at the start of the sample
    ]
)


class PointMassArrays(NamedTuple):
    """What the point mass is made of, as its kernels take it."""

    model: npt.NDArray[Any]  # (1,) MODEL
    wind: npt.NDArray[Any]  # (1,) WIND
    state: npt.NDArray[Any]  # (1,) POINT_MASS_STATE


@compiled
def _rates(
    model: ModelRecord,
    start: Any,
    x: Vector,
    thrust: float,
    load_factor: float,
    bank: float,
    out: Vector,
) -> None:
    """Derivative of the state `x` at a delivered thrust and effective commands, in still air.

    `start`: ANGLES near those of `x`.
    """
    at = at_condition(model, x[0], x[5])
    frequency, damping = model.response_frequency, model.response_damping
    out[6], out[7] = 0.0, 0.0
    if frequency[0] > 0.0:
        out[6] = x[7]
        out[7] = lag_acceleration(x[6], x[7], load_factor, frequency[0], damping[0], 0.0)
    out[8], out[9] = 0.0, 0.0
    cb, sb = start.cos_bank, start.sin_bank
    if frequency[1] > 0.0:
        most = model.bank_acceleration_max
        out[8] = x[9]
        out[9] = lag_acceleration(x[8], x[9], bank, frequency[1], damping[1], most)
        cb, sb = turned(cb, sb, x[8] - start.bank)
    cp, sp = turned(start.cos_path, start.sin_path, x[1] - start.path)
    ch, sh = turned(start.cos_heading, start.sin_heading, x[2] - start.heading)
    out[0], out[1], out[2] = derivatives(at, x[0], cp, sp, thrust, x[6], cb, sb)
    out[3], out[4], out[5] = x[0] * cp * ch, x[0] * cp * sh, x[0] * sp  # (42)


@compiled
def _remember_angles(start: Any, x: Vector) -> None:
    """Path, heading and bank of the state `x`, with their cosines and sines."""
    start.path, start.heading, start.bank = x[1], x[2], x[8]
    start.cos_path, start.sin_path = math.cos(x[1]), math.sin(x[1])
    start.cos_heading, start.sin_heading = math.cos(x[2]), math.sin(x[2])
    start.cos_bank, start.sin_bank = math.cos(x[8]), math.sin(x[8])


@compiled
def _runge_kutta(
    model: ModelRecord, wind: WindRecord, state: Any, load_factor: float, bank: float, dt: float
) -> None:
    """One classical Runge-Kutta step of `dt` seconds, in place."""
    x, y, k, start, thrust = state.x, state.y, state.k, state.start, state.thrust
    for stage in range(4):
        share = dt if stage == 3 else 0.5 * dt
        for a in range(x.size):
            y[a] = x[a] if stage == 0 else x[a] + share * k[stage - 1, a]
        _rates(model, start, y, thrust, load_factor, bank, k[stage])
    for a in range(x.size):
        x[a] += dt / 6.0 * (k[0, a] + 2.0 * (k[1, a] + k[2, a]) + k[3, a])
    if wind.still == 0:
        _blow(wind, x, dt)


@compiled
def _blow(wind: WindRecord, x: Vector, dt: float) -> None:
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
    plant: PointMassArrays, record: Records, i: int, dt: float, substeps: int
) -> None:
    """Fly the commands of row `i` for `dt` seconds through the wind of `wind_step`.

    Thrust, load factor and bank in force are written to row `i` where they act at once; the
    commands are held within the aircraft's limits, the effectiveness of row `i` multiplies them.
    """
    m, s, wind, row = plant.model[0], plant.state[0], plant.wind[0], record[i]
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
    _remember_angles(s.start, x)
    for _ in range(substeps):
        at = at_condition(m, x[0], x[5])
        if m.spool_up[0] > 0.0:
            s.rotor_speed = next_rotor_speed(m, at, s.rotor_speed, row.thrust_cmd, dt / substeps)
            healthy = healthy_thrust(at, s.rotor_speed, row.thrust_cmd)
        else:
            healthy = min(max(row.thrust_cmd, at.thrust_idle), at.thrust_maximum)
        s.thrust = row.effectiveness_thrust * healthy
        _runge_kutta(m, wind, s, load_factor, bank, dt / substeps)
        now = (s.rotor_speed, s.thrust, row.thrust_cmd)
        s.fuel_flow = burn_fuel(m, at, s.fuel_flow, *now, dt / substeps)
        if m.bank_rate_max > 0.0:
            x[9] = min(max(x[9], -m.bank_rate_max), m.bank_rate_max)
    if m.spool_up[0] == 0.0:
        row.thrust = s.thrust
        row.drag = polar_drag(at, row.airspeed, s.thrust, x[6])[0]


@compiled
def point_mass_truth(plant: PointMassArrays, record: Records, i: int, dt: float) -> None:
    """Write the state of the aircraft and the wind to row `i`, and move the wind on.

    The attitude is that of flight without sideslip.
    """
    m, s, wind, row = plant.model[0], plant.state[0], plant.wind, record[i]
    x = s.x
    at = at_condition(m, x[0], x[5])
    row.airspeed, row.flight_path_angle, row.heading = x[0], x[1], x[2]
    row.north, row.east, row.altitude = x[3], x[4], x[5]
    row.load_factor, row.bank_angle = x[6], x[8]
    row.thrust = s.thrust
    row.drag, row.alpha = polar_drag(at, x[0], s.thrust, x[6])
    row.sideslip = 0.0
    row.mach = x[0] / at.sound_speed
    row.mass, row.fuel = m.mass, fuel_on_board(m)
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
