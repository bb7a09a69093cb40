"""Lift from what an aircraft measures of itself, as identified."""

from typing import Any

from ftc_jsb.compiled import compiled
from ftc_jsb.point_mass.drag import between
from ftc_jsb.point_mass.model import bilinear, bracket


@compiled
def measured_lift_coefficient(
    model: Any,
    mach: float,
    alpha: float,
    elevator: float,
    flap: float,
    pitch_rate_per_speed: float,
    path_rate_per_speed: float,
) -> float:
    """Lift coefficient, without thrust's part, from measured angles and rates.

    The sum of tables over (Mach, alpha) and (alpha, elevator), of a slope in q / V that depends on alpha,
    and of terms in the path's rate over V and in flap. The path's rate is g / V (n - cos(gamma) cos(mu)), by
    which the angle of attack of a lifting aircraft turns slower than its nose: d(alpha)/dt = q - it.

    Args:
        model: a MODEL record.
        mach: Mach number.
        alpha, elevator, flap: [rad].
        pitch_rate_per_speed: q / V [rad/m].
        path_rate_per_speed: as above, over V [rad/m].
    """
    i, a = bracket(model.measured_mach, model.measured_mach_count, mach)
    j, b = bracket(model.measured_alpha, model.measured_alpha_count, alpha)
    k, c = bracket(model.measured_elevator, model.measured_elevator_count, elevator)
    return float(
        bilinear(model.lift_mach_alpha, i, a, j, b)
        + bilinear(model.lift_alpha_elevator, j, b, k, c)
        + between(model.lift_pitch_rate, j, b) * pitch_rate_per_speed
        + model.lift_path_rate * path_rate_per_speed
        + model.lift_flap * flap
    )
