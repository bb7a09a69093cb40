"""Control law (17)/(20) for the point mass: F and G of (14) at the trim input, inverted.

With y = x the index of every output is 1, and u = u_n + G^-1 (y_m' - K e - F(x, u_n, k)), which is
(17) with f = F(x, u_n) - g u_n of (6) put in. The sign of K e is the stabilising one, as in (18):
e = y - y_m, so that (17) and (20) as printed, + K e, would drive the error away.
"""

import math

from ftc_jsb.compiled import compiled
from ftc_jsb.point_mass.drag import alpha_slope, angle_of_attack, drag_coefficient, drag_slope
from ftc_jsb.point_mass.dynamics import aerodynamic_state, path_rates
from ftc_jsb.point_mass.model import Condition

SMALLEST_LOAD_FACTOR = 0.05  # G is singular at n = 0: its bank column is held at this size


@compiled
def airspeed_row(
    at: Condition, airspeed: float, thrust: float, load_factor: float
) -> tuple[float, float, float]:
    """Along-path force [N] and its derivatives to delivered thrust [-] and load factor [N].

    The first row of G in (14) is these derivatives over the mass.
    """
    pressure_area = 0.5 * at.density * airspeed * airspeed * at.area
    weight = at.mass * at.gravity
    lift_coefficient, alpha = aerodynamic_state(at, airspeed, thrust, load_factor)
    force = thrust * math.cos(alpha) - pressure_area * drag_coefficient(at, lift_coefficient)
    to_lift = -thrust * math.sin(alpha) * alpha_slope(at, lift_coefficient)
    to_lift -= pressure_area * drag_slope(at, lift_coefficient)
    normal = load_factor * weight / pressure_area
    first_alpha = angle_of_attack(at, normal)
    lift_to_thrust = -math.sin(first_alpha) / pressure_area
    lift_to_load = weight / pressure_area
    lift_to_load *= 1.0 - thrust * math.cos(first_alpha) * alpha_slope(at, normal) / pressure_area
    return force, math.cos(alpha) + to_lift * lift_to_thrust, to_lift * lift_to_load


@compiled
def control_law(
    at: Condition,
    airspeed: float,
    flight_path_angle: float,
    trim_thrust: float,
    trim_load_factor: float,
    trim_bank_angle: float,
    effectiveness: tuple[float, float, float],
    airspeed_rate: float,
    flight_path_rate: float,
    heading_rate: float,
) -> tuple[float, float, float]:
    """Commands that give the wanted rates y_m' - K e: (17), (20), before any limit.

    The lower block of G is a rotation by the bank angle and a division by n, so G is inverted in
    closed form.

    Args:
        at: the model at this flight condition.
        airspeed, flight_path_angle: state or its estimate [m/s], [rad].
        trim_thrust, trim_load_factor, trim_bank_angle: u_n of (10) [N], [-], [rad].
        effectiveness: factors of the three channels, above zero.
        airspeed_rate, flight_path_rate, heading_rate: wanted [m/s^2], [rad/s], [rad/s].

    Returns:
        Thrust [N], load factor [-] and bank angle [rad].
    """
    thrust = effectiveness[0] * trim_thrust
    load_factor = effectiveness[1] * trim_load_factor
    bank_angle = effectiveness[2] * trim_bank_angle
    force, force_to_thrust, force_to_load = airspeed_row(at, airspeed, thrust, load_factor)
    cos_bank, sin_bank = math.cos(bank_angle), math.sin(bank_angle)
    cos_path, sin_path = math.cos(flight_path_angle), math.sin(flight_path_angle)
    rates = path_rates(at, airspeed, cos_path, sin_path, force, load_factor, cos_bank, sin_bank)
    climb = airspeed / at.gravity * (flight_path_rate - rates[1])
    turn = airspeed / at.gravity * cos_path * (heading_rate - rates[2])
    divisor = load_factor
    if abs(divisor) < SMALLEST_LOAD_FACTOR:
        divisor = math.copysign(SMALLEST_LOAD_FACTOR, load_factor)
    load_factor_step = climb * cos_bank + turn * sin_bank
    bank_step = (turn * cos_bank - climb * sin_bank) / divisor
    thrust_step = (
        at.mass * (airspeed_rate - rates[0]) - force_to_load * load_factor_step
    ) / force_to_thrust
    return (
        trim_thrust + thrust_step / effectiveness[0],
        trim_load_factor + load_factor_step / effectiveness[1],
        trim_bank_angle + bank_step / effectiveness[2],
    )
