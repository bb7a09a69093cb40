"""Path tracking, y = position, index 2 in each direction: the outer kinematics of the loop `path`.

Position differentiated twice is the acceleration, which is the rates of (41) turned into the level
frame. The law for y = position is therefore the law for y = [V, gamma, chi] with the rates that the
wanted acceleration asks for; that both are the same is tested against the general theory.
"""

import math

from ftc_jsb.compiled import compiled

Vector = tuple[float, float, float]


@compiled
def acceleration(
    airspeed: float,
    flight_path_angle: float,
    heading: float,
    airspeed_rate: float,
    flight_path_rate: float,
    heading_rate: float,
) -> Vector:
    """Acceleration north, east and up [m/s^2] of given rates: the derivative of (42)."""
    cp, sp = math.cos(flight_path_angle), math.sin(flight_path_angle)
    ch, sh = math.cos(heading), math.sin(heading)
    climb = airspeed * flight_path_rate
    turn = airspeed * cp * heading_rate
    level = airspeed_rate * cp - climb * sp
    return level * ch - turn * sh, level * sh + turn * ch, airspeed_rate * sp + climb * cp


@compiled
def rates_of(airspeed: float, flight_path_angle: float, heading: float, wanted: Vector) -> Vector:
    """Rates of airspeed [m/s^2], flight path and heading [rad/s] that make an acceleration.

    The inverse of `acceleration`; singular at zero airspeed and at a vertical path, as (41) is.
    """
    cp, sp = math.cos(flight_path_angle), math.sin(flight_path_angle)
    ch, sh = math.cos(heading), math.sin(heading)
    level = wanted[0] * ch + wanted[1] * sh
    turn = wanted[1] * ch - wanted[0] * sh
    climb = wanted[2] * cp - level * sp
    return level * cp + wanted[2] * sp, climb / airspeed, turn / (airspeed * cp)
