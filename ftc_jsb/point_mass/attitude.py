"""Attitude of a point mass in coordinated flight: the wind axes, pitched up by the angle of attack."""

import math
from typing import Any

from ftc_jsb.compiled import compiled

Angles = tuple[float, float, float]


@compiled
def attitude(flight_path_angle: float, heading: float, bank_angle: float, alpha: float) -> Angles:
    """Roll, pitch and yaw [rad] of an aircraft without sideslip.

    Body x is the velocity's direction turned up by alpha in the plane of symmetry, which is banked
    about the velocity (Etkin, Dynamics of Atmospheric Flight, 4.3, with sideslip 0); the inverse of
    `six_dof.observation` there.

    Args:
        flight_path_angle, heading: of the air-relative velocity [rad].
        bank_angle: about the velocity [rad].
        alpha: [rad].

    Returns:
        Yaw is continuous where the heading is; roll is in (-pi, pi].
    """
    sg, cg = math.sin(flight_path_angle), math.cos(flight_path_angle)
    sb, cb = math.sin(bank_angle), math.cos(bank_angle)
    sa, ca = math.sin(alpha), math.cos(alpha)
    forward = ca * cg - sa * cb * sg  # body x in the level frame that looks along the heading
    right = sa * sb
    up = ca * sg + sa * cb * cg
    roll = math.atan2(sb * cg, cb * cg * ca - sg * sa)
    pitch = math.asin(min(max(up, -1.0), 1.0))
    return roll, pitch, heading + math.atan2(right, forward)


@compiled
def body_rates(before: Any, after: Any, dt: float) -> Angles:
    """Roll, pitch and yaw rate [rad/s] between two attitudes `dt` seconds apart.

    Differences of the Euler angles, turned into body axes at their mean.
    """
    roll, pitch = 0.5 * (before[0] + after[0]), 0.5 * (before[1] + after[1])
    turn = (after[0] - before[0]) % (2.0 * math.pi)
    if turn > math.pi:
        turn -= 2.0 * math.pi
    roll_dot, pitch_dot = turn / dt, (after[1] - before[1]) / dt
    yaw_dot = (after[2] - before[2]) / dt
    sr, cr, sp, cp = math.sin(roll), math.cos(roll), math.sin(pitch), math.cos(pitch)
    return (
        roll_dot - yaw_dot * sp,
        pitch_dot * cr + yaw_dot * cp * sr,
        yaw_dot * cp * cr - pitch_dot * sr,
    )
