"""What JSBSim's properties say of the aircraft, in SI: the truth of one sample."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ftc_jsb.compiled import compiled
from ftc_jsb.frames import continuous, path_from_attitude
from ftc_jsb.scenario.schema import Initial
from ftc_jsb.units import FOOT, POUND_FORCE, POUND_MASS
from ftc_jsb.vocabulary.kernel_types import Records, Vector

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
    "forces/fbx-total-lbs",
    "forces/fbz-total-lbs",
    "position/h-sl-ft",
    "position/ecef-x-ft",
    "position/ecef-y-ft",
    "position/ecef-z-ft",
    "inertia/weight-lbs",
    "forces/fwx-aero-lbs",
    "forces/fby-total-lbs",
    "atmosphere/total-wind-north-fps",
    "atmosphere/total-wind-east-fps",
    "atmosphere/total-wind-down-fps",
    "propulsion/total-fuel-lbs",
)
POSITION_NAMES = ("throttle", "elevator", "aileron", "rudder", "flap")  # of aircraft.toml
POSITIONS = len(PROPERTIES)
THRUST = POSITIONS + len(POSITION_NAMES)

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


def place_origin(state: Any, initial: Initial, origin: Sequence[float]) -> None:
    """Put the tangent plane of the recording where a flight begins.

    Args:
        state: one JSBSIM_STATE record, changed in place.
        initial: [initial] of the scenario.
        origin: x, y, z of it, Earth-centred, Earth-fixed [m].
    """
    state["origin"] = origin
    latitude = math.radians(initial.latitude_deg)
    longitude = math.radians(initial.longitude_deg)
    state["north"] = (
        -math.sin(latitude) * math.cos(longitude),
        -math.sin(latitude) * math.sin(longitude),
        math.cos(latitude),
    )
    state["east"] = (-math.sin(longitude), math.cos(longitude), 0.0)
    state["heading"] = state["yaw"] = math.radians(initial.heading_deg)


@compiled
def observe(raw: Vector, state: Any, record: Records, i: int) -> None:
    """JSBSim's properties as SI truth in row `i`.

    Flight path, heading and bank are those of the air-relative velocity, from attitude, alpha and
    beta: the wind axes in the local level frame. Steady wind leaves them untouched.

    Load factors are the frame's forces (all but gravity) over weight: JSBSim's own accelerations/N* are
    those of the frame before, 5 ms late beside angles and forces.

    Args:
        raw: values of PROPERTIES, control positions (throttle, elevator, aileron, rudder, flap)
            and engine thrusts.
        state: (1,) JSBSIM_STATE.
        record: (rows,) of the recording.
        i: row.
    """
    s, row = state[0], record[i]
    alpha, beta, phi, theta, psi = raw[2], raw[3], raw[4], raw[5], raw[6]
    path, turn, bank = path_from_attitude(alpha, beta, phi, theta)
    s.heading = continuous(psi + turn, s.heading)
    s.yaw = continuous(psi, s.yaw)
    row.airspeed = raw[0] * FOOT
    row.flight_path_angle = path
    row.heading = s.heading
    row.mach = raw[1]
    row.alpha, row.sideslip = alpha, beta
    s.bank = continuous(bank, s.bank)
    row.bank_angle = s.bank
    row.roll, row.pitch, row.yaw = phi, theta, s.yaw
    row.roll_rate, row.pitch_rate, row.yaw_rate = raw[7], raw[8], raw[9]
    weight = raw[16]
    row.load_factor_x, row.load_factor_y = raw[10] / weight, raw[18] / weight
    row.load_factor_z = -raw[11] / weight
    row.load_factor = row.load_factor_z * math.cos(alpha) + row.load_factor_x * math.sin(alpha)
    row.wind_north, row.wind_east = raw[19] * FOOT, raw[20] * FOOT
    row.wind_up = -raw[21] * FOOT
    row.altitude = raw[12] * FOOT
    row.north, row.east = 0.0, 0.0
    for k in range(3):
        offset = raw[13 + k] * FOOT - s.origin[k]
        row.north += s.north[k] * offset
        row.east += s.east[k] * offset
    row.mass = raw[16] * POUND_MASS
    row.fuel = raw[22] * POUND_MASS
    row.drag = raw[17] * POUND_FORCE  # positive against the velocity
    row.throttle, row.elevator, row.aileron = raw[POSITIONS], raw[POSITIONS + 1], raw[POSITIONS + 2]
    row.rudder, row.flap = raw[POSITIONS + 3], raw[POSITIONS + 4]
    row.thrust = 0.0
    for k in range(THRUST, raw.size):
        row.thrust += raw[k] * POUND_FORCE
