"""The point-mass equations of motion (41)-(42), once: plant, filter and law all call these."""

import math

from ftc_jsb.compiled import compiled, inlined
from ftc_jsb.point_mass.drag import angle_of_attack, drag_coefficient
from ftc_jsb.point_mass.model import Condition, pressure_area


@inlined
def aerodynamic_state(
    at: Condition, airspeed: float, thrust: float, load_factor: float
) -> tuple[float, float]:
    """Lift coefficient and angle of attack [rad] that give a load factor.

    The load factor is all non-gravity force normal to the velocity over weight, so the thrust's
    part T sin(alpha) is not lift: C_L = (n W - T sin alpha) / (q S), alpha at the C_L without it.
    With no angle of attack (the paper's aircraft), C_L = n W / (q S).
    """
    area = pressure_area(at, airspeed)
    normal_coefficient = load_factor * at.mass * at.gravity / area
    alpha = angle_of_attack(at, normal_coefficient)
    if alpha == 0.0:
        return normal_coefficient, 0.0
    lift_coefficient = normal_coefficient - thrust * math.sin(alpha) / area
    return lift_coefficient, angle_of_attack(at, lift_coefficient)


@inlined
def polar_drag(
    at: Condition, airspeed: float, thrust: float, load_factor: float
) -> tuple[float, float]:
    """Drag [N] by (43) and angle of attack [rad] at delivered thrust [N] and load factor."""
    lift_coefficient, alpha = aerodynamic_state(at, airspeed, thrust, load_factor)
    area = pressure_area(at, airspeed)
    return area * drag_coefficient(at, lift_coefficient), alpha


@inlined
def path_rates(
    at: Condition,
    airspeed: float,
    cos_path: float,
    sin_path: float,
    along_path_force: float,
    load_factor: float,
    cos_bank: float,
    sin_bank: float,
) -> tuple[float, float, float]:
    """Rates of airspeed [m/s^2], flight path angle and heading [rad/s]: (41).

    `along_path_force` is T cos(alpha) - D [N]; the paper has alpha = 0. Flight path angle and bank
    come as cosine and sine, which a caller has at less cost than a new sine: see `turned`.
    """
    g = at.gravity
    weight = at.mass * g
    return (
        g * (along_path_force / weight - sin_path),
        g / airspeed * (load_factor * cos_bank - cos_path),
        g * load_factor * sin_bank / (airspeed * cos_path),
    )


@inlined
def derivatives(
    at: Condition,
    airspeed: float,
    cos_path: float,
    sin_path: float,
    thrust: float,
    load_factor: float,
    cos_bank: float,
    sin_bank: float,
) -> tuple[float, float, float]:
    """(41) with the drag polar: rates of airspeed, flight path angle and heading.

    Args:
        at: the model at this flight condition.
        airspeed: [m/s]
        cos_path, sin_path: of the flight path angle
        thrust: delivered [N]
        load_factor: [-]
        cos_bank, sin_bank: of the bank angle about the velocity

    Returns:
        [m/s^2], [rad/s], [rad/s]. Singular at zero airspeed and at a vertical path.
    """
    drag, alpha = polar_drag(at, airspeed, thrust, load_factor)
    along = thrust * math.cos(alpha) if alpha != 0.0 else thrust
    force = along - drag
    return path_rates(at, airspeed, cos_path, sin_path, force, load_factor, cos_bank, sin_bank)


@compiled
def velocity(
    airspeed: float, flight_path_angle: float, heading: float
) -> tuple[float, float, float]:
    """Velocity north, east and up [m/s]: (42), with the paper's x, y, z in that order."""
    level = airspeed * math.cos(flight_path_angle)
    return (
        level * math.cos(heading),
        level * math.sin(heading),
        airspeed * math.sin(flight_path_angle),
    )


@compiled
def level_trim_thrust(at: Condition, airspeed: float, flight_path_angle: float) -> float:
    """Thrust [N] that holds airspeed and flight path angle, wings level, by fixed-point iteration."""
    weight = at.mass * at.gravity
    load_factor = math.cos(flight_path_angle)
    thrust = 0.0
    for _ in range(20):  # converges by a factor of about sin(alpha) a turn
        drag, alpha = polar_drag(at, airspeed, thrust, load_factor)
        thrust = (drag + weight * math.sin(flight_path_angle)) / math.cos(alpha)
    return thrust


@compiled
def load_factor_limit(
    at: Condition, airspeed: float, load_factor_max: float, lift_max: float
) -> float:
    """Upper limit of the load factor: min(n_max, C_Lmax q S / W)."""
    area = pressure_area(at, airspeed)
    return min(load_factor_max, lift_max * area / (at.mass * at.gravity))
