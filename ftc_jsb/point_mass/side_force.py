"""Side force of sideslip, and sideslip of a measured side force: two ways to know one angle."""

import math
from typing import Any, NamedTuple

from ftc_jsb.compiled import compiled
from ftc_jsb.point_mass.drag import between
from ftc_jsb.point_mass.model import bracket


class SideRates(NamedTuple):
    """What makes side force beside sideslip."""

    roll_rate: float  # p / V [rad/m]
    yaw_rate: float  # r / V [rad/m]
    aileron: float  # [rad]
    rudder: float  # [rad]


class Sideslip(NamedTuple):
    """Sideslip that a side force tells."""

    angle: float  # [rad]
    slope: float  # dC_Y/d(sideslip) there [1/rad]


@compiled
def side_force_coefficient(
    model: Any, mach: float, alpha: float, sideslip: float, others: SideRates
) -> float:
    """C_Y along the body's y axis, as identified.

    Args:
        model: a MODEL record.
        mach: Mach number.
        alpha, sideslip: [rad].
        others: rates and surfaces.
    """
    slope, rest = _slope_and_rest(model, mach, alpha, others)
    return float(rest + sideslip * (slope + model.side_sideslip_squared * abs(sideslip)))


@compiled
def sideslip_of_side_force(
    model: Any, mach: float, alpha: float, coefficient: float, others: SideRates
) -> Sideslip:
    """The sideslip at which `side_force_coefficient` is `coefficient`, in closed form.

    Args:
        model, mach, alpha, others: as `side_force_coefficient` takes them.
        coefficient: C_Y.
    """
    slope, rest = _slope_and_rest(model, mach, alpha, others)
    sign = 1.0 if slope > 0.0 else -1.0
    force, linear = sign * (coefficient - rest), sign * slope
    square = sign * model.side_sideslip_squared
    root = math.sqrt(max(linear * linear + 4.0 * square * abs(force), 0.0))
    angle = 2.0 * force / (linear + root)
    return Sideslip(angle, slope + 2.0 * model.side_sideslip_squared * abs(angle))


@compiled
def _slope_and_rest(
    model: Any, mach: float, alpha: float, others: SideRates
) -> tuple[float, float]:
    """Slope over sideslip at none, and C_Y there."""
    i, a = bracket(model.measured_mach, model.measured_mach_count, mach)
    j, b = bracket(model.measured_alpha, model.measured_alpha_count, alpha)
    slope = between(model.side_sideslip_mach, i, a) + between(model.side_sideslip_alpha, j, b)
    rest = (
        between(model.side_roll_rate, j, b) * others.roll_rate
        + between(model.side_yaw_rate, j, b) * others.yaw_rate
        + model.side_aileron * others.aileron
        + model.side_rudder * others.rudder
    )
    return slope, rest
