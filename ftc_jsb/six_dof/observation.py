"""What JSBSim's properties say of the aircraft, in SI: truth and measurements of one sample."""

import math
from typing import Any

import numpy as np

from ftc_jsb.compiled import compiled
from ftc_jsb.units import FOOT, POUND_FORCE, POUND_MASS

# The properties read at every sample, in the order of the kernel below; then control positions and
# one thrust for each engine.
PROPERTIES = (
    "velocities/vt-fps",
    "velocities/mach",
    "aero/alpha-rad",
    "aero/beta-rad",
    "attitude/phi-rad",
    "attitude/theta-rad",
    "attitude/psi-rad",
    "velocities/p-rad_sec",
    "velocities/q-rad_sec",
    "velocities/r-rad_sec",
    "accelerations/Nx",
    "accelerations/Nz",
    "position/h-sl-ft",
    "position/ecef-x-ft",
    "position/ecef-y-ft",
    "position/ecef-z-ft",
    "inertia/weight-lbs",
    "forces/fwx-aero-lbs",
)
THRUST = len(PROPERTIES) + 5

JSBSIM_STATE = np.dtype(
    [
        ("origin", float, (3,)),  # ECEF [m]
        ("north", float, (3,)),  # unit vectors of the tangent plane in ECEF
        ("east", float, (3,)),
        ("heading", float),  # [rad], continuous
        ("yaw", float),
        ("bank", float),
    ]
)


@compiled
def _continuous(angle: float, previous: float) -> float:
    """`angle` plus the whole turns that bring it nearest to `previous` [rad]."""
    return angle + 2.0 * math.pi * round((previous - angle) / (2.0 * math.pi))


@compiled
def observe(raw: Any, state: Any, record: Any, i: int) -> None:
    """JSBSim's properties as SI truth and measurements in row `i`.

    Flight path, heading and bank are those of the air-relative velocity, from attitude, alpha and
    beta: the wind axes in the local level frame. Steady wind leaves them untouched.

    Args:
        raw: values of PROPERTIES, control positions (throttle, elevator, aileron, rudder, flap)
            and engine thrusts.
        state: (1,) JSBSIM_STATE.
        record: (rows,) of the recording.
        i: row.
    """
    s, row = state[0], record[i]
    alpha, beta, phi, theta, psi = raw[2], raw[3], raw[4], raw[5], raw[6]
    sa, ca, sb, cb = math.sin(alpha), math.cos(alpha), math.sin(beta), math.cos(beta)
    sp, cp, st, ct = math.sin(phi), math.cos(phi), math.sin(theta), math.cos(theta)
    # The velocity's direction in body axes is (ca cb, sb, sa cb); in the level frame, yaw removed:
    forward = ct * ca * cb + st * (sp * sb + cp * sa * cb)
    right = cp * sb - sp * sa * cb
    climb = st * ca * cb - ct * (sp * sb + cp * sa * cb)  # sin(gamma)
    sin_bank = ca * sb * st + cb * sp * ct - sa * sb * cp * ct  # times cos(gamma)
    cos_bank = sa * st + ca * cp * ct
    heading = psi + math.atan2(right, forward)
    s.heading = _continuous(heading, s.heading)
    s.yaw = _continuous(psi, s.yaw)
    row.airspeed = raw[0] * FOOT
    row.flight_path_angle = math.asin(min(max(climb, -1.0), 1.0))
    row.heading = s.heading
    row.mach = raw[1]
    row.alpha, row.sideslip = alpha, beta
    s.bank = _continuous(math.atan2(sin_bank, cos_bank), s.bank)
    row.bank_angle = s.bank
    row.roll, row.pitch, row.yaw = phi, theta, s.yaw
    row.roll_rate, row.pitch_rate, row.yaw_rate = raw[7], raw[8], raw[9]
    row.load_factor = raw[11] * ca + raw[10] * sa
    row.altitude = raw[12] * FOOT
    row.north, row.east = 0.0, 0.0
    for k in range(3):
        offset = raw[13 + k] * FOOT - s.origin[k]
        row.north += s.north[k] * offset
        row.east += s.east[k] * offset
    row.mass = raw[16] * POUND_MASS
    row.drag = raw[17] * POUND_FORCE  # positive against the velocity
    row.throttle, row.elevator, row.aileron = raw[18], raw[19], raw[20]
    row.rudder, row.flap = raw[21], raw[22]
    row.thrust = 0.0
    for k in range(THRUST, raw.size):
        row.thrust += raw[k] * POUND_FORCE
    row.airspeed_meas = row.airspeed
    row.flight_path_angle_meas = row.flight_path_angle
    row.heading_meas = row.heading
    row.north_meas, row.east_meas, row.altitude_meas = row.north, row.east, row.altitude
    row.load_factor_meas = row.load_factor
    row.bank_angle_meas = row.bank_angle
    row.alpha_meas, row.sideslip_meas = alpha, beta
    row.pitch_rate_meas = row.pitch_rate
    row.elevator_meas, row.flap_meas = row.elevator, row.flap
