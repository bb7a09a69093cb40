"""Attitude and path: the two ways to say how an aircraft lies in the air and where it goes.

Wind axes are turned from body axes by angle of attack and sideslip; their own Euler angles in the
level frame are heading, flight path angle and bank about the velocity. All angles in rad, all of
the air-relative velocity, so that steady wind touches none of them.
"""

import math
from typing import Any

from ftc_jsb.compiled import compiled
from ftc_jsb.units import STANDARD_GRAVITY


@compiled
def path_from_attitude(
    alpha: float, beta: float, roll: float, pitch: float
) -> tuple[float, float, float]:
    """Flight path angle, heading relative to the yaw angle, and bank about the velocity.

    The velocity's direction in body axes is (cos a cos b, sin b, sin a cos b).
    """
    sa, ca, sb, cb = math.sin(alpha), math.cos(alpha), math.sin(beta), math.cos(beta)
    sp, cp, st, ct = math.sin(roll), math.cos(roll), math.sin(pitch), math.cos(pitch)
    forward = ct * ca * cb + st * (sp * sb + cp * sa * cb)
    right = cp * sb - sp * sa * cb
    climb = st * ca * cb - ct * (sp * sb + cp * sa * cb)  # sin(gamma)
    sin_bank = ca * sb * st + cb * sp * ct - sa * sb * cp * ct  # times cos(gamma)
    cos_bank = sa * st + ca * cp * ct
    path = math.asin(min(max(climb, -1.0), 1.0))
    return path, math.atan2(right, forward), math.atan2(sin_bank, cos_bank)


@compiled
def measure_path(row: Any) -> None:
    """Path, heading, bank, load factor and force along the velocity that a row's readings tell of.

    Args:
        row: of the recording; attitude, vanes and accelerometers (`_meas`) are read.
    """
    alpha, sideslip = row.alpha_meas, row.sideslip_meas
    path, turn, bank = path_from_attitude(alpha, sideslip, row.roll_meas, row.pitch_meas)
    row.flight_path_angle_meas = path
    row.heading_meas = row.yaw_meas + turn
    row.bank_angle_meas = bank
    row.load_factor_meas = row.load_factor_z_meas * math.cos(
        alpha
    ) + row.load_factor_x_meas * math.sin(alpha)
    measure_force(row)


@compiled
def measure_force(row: Any) -> None:
    """Force along the velocity over mass [m/s^2] that a row's readings tell of."""
    sa, ca = math.sin(row.alpha_meas), math.cos(row.alpha_meas)
    sb, cb = math.sin(row.sideslip_meas), math.cos(row.sideslip_meas)
    row.acceleration_meas = STANDARD_GRAVITY * (
        row.load_factor_x_meas * ca * cb
        + row.load_factor_y_meas * sb
        - row.load_factor_z_meas * sa * cb
    )


@compiled
def attitude_from_path(path: float, bank: float, alpha: float) -> tuple[float, float, float]:
    """Roll, pitch, and yaw relative to the heading, of flight without sideslip.

    The body's x axis is the velocity turned up by alpha in the plane of symmetry, which bank turns
    about the velocity.
    """
    if alpha == 0.0:
        return continuous(bank, 0.0), path, 0.0
    sa, ca = math.sin(alpha), math.cos(alpha)
    sg, cg = math.sin(path), math.cos(path)
    sm, cm = math.sin(bank), math.cos(bank)
    # Body axes in the frame of the heading: x forward, y to the right, z down
    x_forward, x_right, x_down = ca * cg - sa * sg * cm, sa * sm, -ca * sg - sa * cg * cm
    y_down, z_down = cg * sm, cg * ca * cm - sg * sa
    pitch = math.asin(min(max(-x_down, -1.0), 1.0))
    return math.atan2(y_down, z_down), pitch, math.atan2(x_right, x_forward)


@compiled
def continuous(angle: float, previous: float) -> float:
    """`angle` plus the whole turns that bring it nearest to `previous`."""
    return angle + 2.0 * math.pi * round((previous - angle) / (2.0 * math.pi))


@compiled
def body_rates(
    before: tuple[float, float, float], after: tuple[float, float, float], dt: float
) -> tuple[float, float, float]:
    """Roll, pitch and yaw rate of the body between two attitudes (roll, pitch, yaw), `dt` s apart.

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
