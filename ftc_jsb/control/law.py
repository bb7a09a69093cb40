"""Control law (17)/(20) for the point mass: F and G of (14) at the trim input, inverted.

With y = x the index of every output is 1, and u = u_n + G^-1 (y_m' - K e - F(x, u_n, k)), which is
(17) with f = F(x, u_n) - g u_n of (6) put in. The sign of K e is the stabilising one, as in (18):
e = y - y_m, so that (17) and (20) as printed, + K e, would drive the error away.
"""

import math
from typing import NamedTuple

from ftc_jsb.compiled import compiled
from ftc_jsb.point_mass.drag import alpha_slope, angle_of_attack, drag_coefficient, drag_slope
from ftc_jsb.point_mass.dynamics import aerodynamic_state, path_rates
from ftc_jsb.point_mass.model import Condition, pressure_area

SMALLEST_LOAD_FACTOR = 0.05  # G is singular at n = 0: its bank column is held at this size


@compiled
def airspeed_row(
    at: Condition, airspeed: float, thrust: float, load_factor: float
) -> tuple[float, float, float]:
    """Along-path force [N] and its derivatives to delivered thrust [-] and load factor [N].

    The first row of G in (14) is these derivatives over the mass.
    """
    area = pressure_area(at, airspeed)
    weight = at.mass * at.gravity
    lift_coefficient, alpha = aerodynamic_state(at, airspeed, thrust, load_factor)
    force = thrust * math.cos(alpha) - area * drag_coefficient(at, lift_coefficient)
    to_lift = -thrust * math.sin(alpha) * alpha_slope(at, lift_coefficient)
    to_lift -= area * drag_slope(at, lift_coefficient)
    normal = load_factor * weight / area
    first_alpha = angle_of_attack(at, normal)
    lift_to_thrust = -math.sin(first_alpha) / area
    lift_to_load = weight / area
    lift_to_load *= 1.0 - thrust * math.cos(first_alpha) * alpha_slope(at, normal) / area
    return force, math.cos(alpha) + to_lift * lift_to_thrust, to_lift * lift_to_load


class Inputs(NamedTuple):
    """A number for each input of (41): a command, a trim input, or the effectiveness of each channel."""

    thrust: float  # [N]
    load_factor: float
    bank_angle: float  # [rad]


class Rates(NamedTuple):
    """Rates of the state of (41)."""

    airspeed: float  # [m/s^2]
    flight_path_angle: float  # [rad/s]
    heading: float  # [rad/s]


@compiled
def control_law(
    at: Condition,
    airspeed: float,
    flight_path_angle: float,
    trim: Inputs,
    effectiveness: Inputs,
    wanted: Rates,
) -> Inputs:
    """Commands that give the wanted rates y_m' - K e: (17), (20), before any limit.

    The lower block of G is a rotation by the bank angle and a division by n, so G is inverted in
    closed form.

    Args:
        at: the model at this flight condition.
        airspeed, flight_path_angle: state or its estimate [m/s], [rad].
        trim: u_n of (10).
        effectiveness: factors of the three channels, above zero.
        wanted: y_m' - K e.
    """
    thrust = effectiveness.thrust * trim.thrust
    load_factor = effectiveness.load_factor * trim.load_factor
    bank_angle = effectiveness.bank_angle * trim.bank_angle
    force, force_to_thrust, force_to_load = airspeed_row(at, airspeed, thrust, load_factor)
    cos_bank, sin_bank = math.cos(bank_angle), math.sin(bank_angle)
    cos_path, sin_path = math.cos(flight_path_angle), math.sin(flight_path_angle)
    rates = path_rates(at, airspeed, cos_path, sin_path, force, load_factor, cos_bank, sin_bank)
    climb = airspeed / at.gravity * (wanted.flight_path_angle - rates[1])
    turn = airspeed / at.gravity * cos_path * (wanted.heading - rates[2])
    divisor = load_factor
    if abs(divisor) < SMALLEST_LOAD_FACTOR:
        divisor = math.copysign(SMALLEST_LOAD_FACTOR, load_factor)
    load_factor_step = climb * cos_bank + turn * sin_bank
    bank_step = (turn * cos_bank - climb * sin_bank) / divisor
    thrust_step = (
        at.mass * (wanted.airspeed - rates[0]) - force_to_load * load_factor_step
    ) / force_to_thrust
    return Inputs(
        trim.thrust + thrust_step / effectiveness.thrust,
        trim.load_factor + load_factor_step / effectiveness.load_factor,
        trim.bank_angle + bank_step / effectiveness.bank_angle,
    )
