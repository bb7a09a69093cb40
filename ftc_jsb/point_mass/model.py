"""The numbers of a point-mass aircraft as one record, and their values at one flight condition.

Table 1 of the paper and an aircraft identified from JSBSim flights fill the same record; the
paper's has one Mach knot, no angle of attack and a constant density.
"""

from typing import Any, NamedTuple

import numpy as np

from ftc_jsb.compiled import compiled, inlined
from ftc_jsb.point_mass.atmosphere import standard_atmosphere
from ftc_jsb.vocabulary.kernel_types import Matrix, Vector

MACH_KNOTS = 40
ALTITUDE_KNOTS = 12
LIFT_KNOTS = 80
ALPHA_KNOTS = 48
ELEVATOR_KNOTS = 12
DRAG_TERMS = 3  # powers 0..2 of the lift coefficient
ALPHA_TERMS = 4  # powers 0..3 of the lift coefficient

MODEL = np.dtype(
    [
        ("gravity", float),  # [m/s^2]
        ("mass", float),  # [kg], now: plant and loop burn their fuel from it, each from its own
        ("mass_start", float),  # [kg], at the start of the flight
        ("mass_empty", float),  # [kg], with dry tanks
        ("fuel_flow", float, (4,)),  # see `fuel.settled_fuel_flow`; the last 0 = none is burnt
        ("fuel_flow_rate", float, (3,)),  # [kg/s^2], upwards dry and in reheat, downwards
        ("area", float),  # [m^2]
        ("load_factor_min", float),
        ("load_factor_max", float),
        ("lift_coefficient_max", float),
        ("constant_density", float),  # [kg/m^3]; 0 = standard atmosphere
        ("constant_sound_speed", float),  # [m/s]; with a constant density
        ("valid_mach", float, (2,)),  # range of the fit; 0, 0 = everywhere
        ("valid_lift", float, (2,)),
        ("valid_altitude", float, (2,)),  # [m]
        ("mach_count", np.int64),
        ("mach", float, (MACH_KNOTS,)),
        ("drag", float, (MACH_KNOTS, DRAG_TERMS)),
        ("alpha", float, (MACH_KNOTS, ALPHA_TERMS)),  # [rad]
        ("lift_count", np.int64),  # knots of the drag table; 0 = no table
        ("lift_first", float),
        ("lift_spacing", float),
        ("drag_table", float, (MACH_KNOTS, LIFT_KNOTS)),  # added to the polynomial
        ("measured_mach_count", np.int64),  # 0 = no drag from measured angles
        ("measured_mach", float, (MACH_KNOTS,)),
        ("measured_alpha_count", np.int64),
        ("measured_alpha", float, (ALPHA_KNOTS,)),  # [rad]
        ("measured_elevator_count", np.int64),
        ("measured_elevator", float, (ELEVATOR_KNOTS,)),  # [rad]
        ("measured_mach_alpha", float, (MACH_KNOTS, ALPHA_KNOTS)),
        ("measured_alpha_elevator", float, (ALPHA_KNOTS, ELEVATOR_KNOTS)),
        ("measured_pitch_rate", float, (ALPHA_KNOTS,)),  # [m/rad], times q / V
        ("measured_flap", float),  # [1/rad]
        ("measured_sideslip", float, (ALPHA_KNOTS,)),  # [1/rad], times its magnitude
        ("measured_sideslip_squared", float),  # [1/rad^2]
        ("measured_lift_count", np.int64),  # 0 = no lift from measured angles
        ("lift_mach_alpha", float, (MACH_KNOTS, ALPHA_KNOTS)),
        ("lift_alpha_elevator", float, (ALPHA_KNOTS, ELEVATOR_KNOTS)),
        ("lift_pitch_rate", float, (ALPHA_KNOTS,)),  # [m/rad], times q / V
        ("lift_path_rate", float),  # [m/rad], times the path's rate / V
        ("lift_flap", float),  # [1/rad]
        ("side_force_count", np.int64),  # 0 = no side force
        ("side_sideslip_mach", float, (MACH_KNOTS,)),  # [1/rad]
        ("side_sideslip_alpha", float, (ALPHA_KNOTS,)),  # [1/rad]
        ("side_sideslip_squared", float),  # [1/rad^2]
        ("side_roll_rate", float, (ALPHA_KNOTS,)),  # [m/rad], times p / V
        ("side_yaw_rate", float, (ALPHA_KNOTS,)),  # [m/rad], times r / V
        ("side_aileron", float),  # [1/rad]
        ("side_rudder", float),  # [1/rad]
        ("deck_mach_count", np.int64),
        ("deck_altitude_count", np.int64),
        ("deck_mach", float, (MACH_KNOTS,)),
        ("deck_altitude", float, (ALTITUDE_KNOTS,)),  # [m]
        ("thrust_idle", float, (MACH_KNOTS, ALTITUDE_KNOTS)),  # [N]
        ("thrust_military", float, (MACH_KNOTS, ALTITUDE_KNOTS)),  # [N]
        ("thrust_maximum", float, (MACH_KNOTS, ALTITUDE_KNOTS)),  # [N]
        ("spool_up", float, (3,)),  # see `thrust.spool_rate`; 0 = thrust follows at once
        ("spool_down", float, (3,)),
        ("response_frequency", float, (2,)),  # [rad/s], load factor and bank; 0 = at once
        ("response_damping", float, (2,)),
        ("bank_rate_max", float),  # [rad/s]; 0 = no limit
        ("bank_acceleration_max", float),  # [rad/s^2]; 0 = no limit
    ]
)


class Condition(NamedTuple):
    """A point-mass model at one Mach number and altitude. SI; thrust is of a healthy engine."""

    gravity: float
    mass: float
    area: float
    density: float
    sound_speed: float
    drag_0: float
    drag_1: float
    drag_2: float
    lift_count: int
    lift_first: float
    lift_spacing: float
    drag_table: Any
    mach_knot: int
    mach_fraction: float
    alpha_0: float
    alpha_1: float
    alpha_2: float
    alpha_3: float
    thrust_idle: float
    thrust_military: float
    thrust_maximum: float


@compiled
def bracket(knots: Vector, count: int, value: float) -> tuple[int, float]:
    """Interval of sorted `knots[:count]` that holds `value`, and the fraction along it, clamped."""
    if count < 2 or value <= knots[0]:
        return 0, 0.0
    if value >= knots[count - 1]:
        return count - 2, 1.0
    index = 0
    while knots[index + 1] < value:
        index += 1
    return index, (value - knots[index]) / (knots[index + 1] - knots[index])


@compiled
def bilinear(table: Matrix, row: int, along_row: float, column: int, along_column: float) -> float:
    """Value of `table` between its rows and columns."""
    if along_row == 0.0 and along_column == 0.0:
        return float(table[row, column])
    next_row = row + 1 if along_row > 0.0 else row
    next_column = column + 1 if along_column > 0.0 else column
    low = table[row, column] + along_column * (table[row, next_column] - table[row, column])
    high = table[next_row, column] + along_column * (
        table[next_row, next_column] - table[next_row, column]
    )
    return float(low + along_row * (high - low))


@inlined
def pressure_area(at: Condition, airspeed: float) -> float:
    """Dynamic pressure times reference area [N] at an airspeed [m/s]: q S of (43)."""
    return 0.5 * at.density * airspeed * airspeed * at.area


@inlined
def air(model: Any, altitude: float) -> tuple[float, float]:
    """Density [kg/m^3] and speed of sound [m/s] that `model` assumes at an altitude [m]."""
    if model.constant_density > 0.0:
        return model.constant_density, model.constant_sound_speed
    return standard_atmosphere(altitude)


@inlined
def at_condition(model: Any, airspeed: float, altitude: float) -> Condition:
    """`model` (one MODEL record) at an airspeed [m/s] and altitude [m].

    Tables are interpolated linearly and held at their ends.
    """
    density, sound_speed = air(model, altitude)
    mach = airspeed / sound_speed
    i, a = bracket(model.mach, model.mach_count, mach)
    j = i + 1 if a > 0.0 else i
    drag = model.drag
    alpha = model.alpha
    r, b = bracket(model.deck_mach, model.deck_mach_count, mach)
    c, d = bracket(model.deck_altitude, model.deck_altitude_count, altitude)
    return Condition(
        model.gravity,
        model.mass,
        model.area,
        density,
        sound_speed,
        drag[i, 0] + a * (drag[j, 0] - drag[i, 0]),
        drag[i, 1] + a * (drag[j, 1] - drag[i, 1]),
        drag[i, 2] + a * (drag[j, 2] - drag[i, 2]),
        model.lift_count,
        model.lift_first,
        model.lift_spacing,
        model.drag_table,
        i,
        a,
        alpha[i, 0] + a * (alpha[j, 0] - alpha[i, 0]),
        alpha[i, 1] + a * (alpha[j, 1] - alpha[i, 1]),
        alpha[i, 2] + a * (alpha[j, 2] - alpha[i, 2]),
        alpha[i, 3] + a * (alpha[j, 3] - alpha[i, 3]),
        bilinear(model.thrust_idle, r, b, c, d),
        bilinear(model.thrust_military, r, b, c, d),
        bilinear(model.thrust_maximum, r, b, c, d),
    )


@compiled
def thrust_limits(model: Any, airspeed: float, altitude: float) -> tuple[float, float]:
    """Idle and greatest thrust [N] of healthy engines at an airspeed [m/s] and altitude [m]."""
    at = at_condition(model[0], airspeed, altitude)
    return at.thrust_idle, at.thrust_maximum
