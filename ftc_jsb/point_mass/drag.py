"""Drag: the polar of (43), its generalisation over Mach, and drag from measured angles."""

import math
from typing import Any

from ftc_jsb.compiled import compiled, inlined
from ftc_jsb.point_mass.model import Condition, bilinear, bracket


@inlined
def drag_coefficient(at: Condition, lift_coefficient: float) -> float:
    """Drag polar C_D(C_L) at one Mach number.

    A parabola, (43) with C_D0 + k C_L^2 for the paper's aircraft, and for an identified one a table
    on top of it, linear between equally spaced lift coefficients.
    """
    c = lift_coefficient
    parabola = at.drag_0 + c * (at.drag_1 + c * at.drag_2)
    if at.lift_count == 0:
        return parabola
    k, fraction = _lift_interval(at, c)
    low, high = _table_column(at, k), _table_column(at, k + 1)
    return parabola + low + min(max(fraction, 0.0), 1.0) * (high - low)


@compiled
def drag_slope(at: Condition, lift_coefficient: float) -> float:
    """dC_D/dC_L of `drag_coefficient`."""
    slope = at.drag_1 + 2.0 * at.drag_2 * lift_coefficient
    if at.lift_count == 0:
        return slope
    k, fraction = _lift_interval(at, lift_coefficient)
    if fraction < 0.0 or fraction > 1.0:
        return slope
    return slope + (_table_column(at, k + 1) - _table_column(at, k)) / at.lift_spacing


@inlined
def _lift_interval(at: Condition, lift_coefficient: float) -> tuple[int, float]:
    """Interval of the drag table, and the place in it: outside [0, 1] beyond the table's ends."""
    place = (lift_coefficient - at.lift_first) / at.lift_spacing
    k = min(max(math.floor(place), 0), at.lift_count - 2)
    return k, place - k


@inlined
def _table_column(at: Condition, k: int) -> float:
    i = at.mach_knot
    low = at.drag_table[i, k]
    if at.mach_fraction == 0.0:
        return float(low)
    return float(low + at.mach_fraction * (at.drag_table[i + 1, k] - low))


@inlined
def angle_of_attack(at: Condition, lift_coefficient: float) -> float:
    """Angle of attack [rad] at a lift coefficient; 0 for the paper's aircraft."""
    c = lift_coefficient
    return at.alpha_0 + c * (at.alpha_1 + c * (at.alpha_2 + c * at.alpha_3))


@compiled
def alpha_slope(at: Condition, lift_coefficient: float) -> float:
    """d(alpha)/dC_L of `angle_of_attack` [rad]."""
    c = lift_coefficient
    return at.alpha_1 + c * (2.0 * at.alpha_2 + c * 3.0 * at.alpha_3)


@compiled
def between(row: Any, j: int, fraction: float) -> float:
    """Value of a row of a table between its knots j and j + 1."""
    if fraction == 0.0:
        return float(row[j])
    return float(row[j] + fraction * (row[j + 1] - row[j]))


@compiled
def measured_drag_coefficient(
    model: Any,
    mach: float,
    alpha: float,
    sideslip: float,
    elevator: float,
    flap: float,
    pitch_rate_per_speed: float,
) -> float:
    """Drag coefficient from what an aircraft measures of itself, as identified.

    The sum of tables over (Mach, alpha) and (alpha, elevator), of slopes in q / V [rad/m] and in the
    magnitude of sideslip that depend on alpha, and of terms in flap and sideslip squared; angles in
    rad, tables linear between knots. It serves the estimator, whose accuracy is the drag's: an error
    dD of the drag is an error dD / T of the effectiveness.
    """
    i, a = bracket(model.measured_mach, model.measured_mach_count, mach)
    j, b = bracket(model.measured_alpha, model.measured_alpha_count, alpha)
    k, c = bracket(model.measured_elevator, model.measured_elevator_count, elevator)
    slope = between(model.measured_pitch_rate, j, b)
    return float(
        bilinear(model.measured_mach_alpha, i, a, j, b)
        + bilinear(model.measured_alpha_elevator, j, b, k, c)
        + slope * pitch_rate_per_speed
        + model.measured_flap * flap
        + between(model.measured_sideslip, j, b) * abs(sideslip)
        + model.measured_sideslip_squared * sideslip * sideslip
    )
