"""Messages about the motion of the aircraft: the truth, in MAVLink's units."""

import math

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.link.message_fields import UNKNOWN_8, UNKNOWN_16, Fields
from ftc_jsb.mavlink.telemetry.geodesy import latitude_longitude
from ftc_jsb.mavlink.telemetry.quaternion import quaternion
from ftc_jsb.mavlink.telemetry.snapshot import Snapshot


def ground_velocity(s: Snapshot) -> tuple[float, float, float]:
    """Velocity over ground, north, east, up [m/s]: the air's and the wind's."""
    row = s.row
    level = row["airspeed"] * math.cos(row["flight_path_angle"])
    return (
        level * math.cos(row["heading"]) + row.get("wind_north", 0.0),
        level * math.sin(row["heading"]) + row.get("wind_east", 0.0),
        row["airspeed"] * math.sin(row["flight_path_angle"]) + row.get("wind_up", 0.0),
    )


def _position(s: Snapshot) -> Fields:
    row = s.row
    latitude, longitude = latitude_longitude(row["north"], row["east"], row["altitude"], s.origin)
    return {"lat": 1e7 * latitude, "lon": 1e7 * longitude}


def _angular_velocity(s: Snapshot) -> Fields:
    return {"rollspeed": s.rates[0], "pitchspeed": s.rates[1], "yawspeed": s.rates[2]}


def _wrapped(angle: float) -> float:
    """[rad] in -pi to pi."""
    return math.remainder(angle, 2.0 * math.pi)


def _centidegrees(angle: float) -> int:
    """[cdeg] in 0 to 35999, or unknown."""
    return math.floor(1e2 * math.degrees(angle)) % 36000 if math.isfinite(angle) else UNKNOWN_16


def _throttle(s: Snapshot) -> float:
    """Commanded over greatest thrust; 0 where there is none."""
    ratio = _command(s, "thrust") / s.thrust_maximum if s.thrust_maximum else 0.0
    return ratio if math.isfinite(ratio) else 0.0


def attitude(s: Snapshot) -> Fields:
    """ATTITUDE."""
    roll, pitch, yaw = s.attitude
    angles = {"roll": _wrapped(roll), "pitch": pitch, "yaw": _wrapped(yaw)}
    return {"time_boot_ms": s.time_boot_ms, **angles, **_angular_velocity(s)}


def attitude_quaternion(s: Snapshot) -> Fields:
    """ATTITUDE_QUATERNION."""
    q = dict(zip(("q1", "q2", "q3", "q4"), quaternion(*s.attitude), strict=True))
    return {"time_boot_ms": s.time_boot_ms, **q, **_angular_velocity(s)}


def global_position_int(s: Snapshot) -> Fields:
    """GLOBAL_POSITION_INT; velocities beyond 327.67 m/s do not fit and are clamped."""
    north, east, up = ground_velocity(s)
    return {
        "time_boot_ms": s.time_boot_ms,
        **_position(s),
        "alt": 1e3 * s.row["altitude"],
        "relative_alt": 1e3 * s.row["altitude"],
        "vx": 1e2 * north,
        "vy": 1e2 * east,
        "vz": -1e2 * up,
        "hdg": _centidegrees(s.attitude[2]),
    }


def local_position_ned(s: Snapshot) -> Fields:
    """LOCAL_POSITION_NED over the scenario's origin at sea level; velocities of any size."""
    north, east, up = ground_velocity(s)
    position = {"x": s.row["north"], "y": s.row["east"], "z": -s.row["altitude"]}
    return {"time_boot_ms": s.time_boot_ms, **position, "vx": north, "vy": east, "vz": -up}


def vfr_hud(s: Snapshot) -> Fields:
    """VFR_HUD with true airspeed; throttle is the commanded thrust over its greatest."""
    north, east, up = ground_velocity(s)
    return {
        "airspeed": s.row["airspeed"],
        "groundspeed": math.hypot(north, east),
        "heading": _centidegrees(s.attitude[2]) // 100,
        "throttle": min(max(100.0 * _throttle(s), 0.0), 100.0),
        "alt": s.row["altitude"],
        "climb": up,
    }


def _command(s: Snapshot, name: str) -> float:
    """A command; the last row of a flight has none, there the truth."""
    value = s.row[f"{name}_cmd"]
    return value if math.isfinite(value) else s.row[name]


def gps_raw_int(s: Snapshot) -> Fields:
    """GPS_RAW_INT: a fix of unknown quality, or none while the receiver gives no reading or is excluded."""
    north, east, _ = ground_velocity(s)
    none, fix = dialect.GPS_FIX_TYPE_NO_FIX, dialect.GPS_FIX_TYPE_3D_FIX
    return {
        "time_usec": s.time_usec,
        "fix_type": none if s.failed("north", "east") else fix,
        **_position(s),
        "alt": 1e3 * s.row["altitude"],
        "eph": UNKNOWN_16,
        "epv": UNKNOWN_16,
        "vel": 1e2 * math.hypot(north, east),
        "cog": _centidegrees(math.atan2(east, north)),
        "satellites_visible": UNKNOWN_8,
    }


def attitude_target(s: Snapshot) -> Fields:
    """ATTITUDE_TARGET: bank command, flight path reference plus alpha, heading reference; thrust."""
    row = s.row
    roll = _command(s, "bank_angle")
    pitch = row["flight_path_angle_ref"] + row["alpha"]
    no_rates = (
        dialect.ATTITUDE_TARGET_TYPEMASK_BODY_ROLL_RATE_IGNORE
        | dialect.ATTITUDE_TARGET_TYPEMASK_BODY_PITCH_RATE_IGNORE
        | dialect.ATTITUDE_TARGET_TYPEMASK_BODY_YAW_RATE_IGNORE
    )
    return {
        "time_boot_ms": s.time_boot_ms,
        "type_mask": no_rates,
        "q": quaternion(roll, pitch, row["heading_ref"]),
        "thrust": _throttle(s),
    }


def nav_controller_output(s: Snapshot) -> Fields:
    """NAV_CONTROLLER_OUTPUT: what is wanted, and reference minus truth."""
    row = s.row
    off_track = (row["north_ref"] - row["north"], row["east_ref"] - row["east"])
    heading = row["heading_ref"]
    return {
        "nav_roll": math.degrees(_command(s, "bank_angle")),
        "nav_pitch": math.degrees(row["flight_path_angle_ref"]),
        "nav_bearing": math.degrees(_wrapped(heading)),
        "target_bearing": math.degrees(_wrapped(row["heading_cmd_raw"])),
        "alt_error": row["altitude_ref"] - row["altitude"],
        "aspd_error": row["airspeed_ref"] - row["airspeed"],
        "xtrack_error": off_track[1] * math.cos(heading) - off_track[0] * math.sin(heading),
    }


def actuator_output_status(s: Snapshot) -> Fields:
    """ACTUATOR_OUTPUT_STATUS: throttle (1 military, 2 reheat), elevator, aileron, rudder, flap [rad]."""
    names = ("throttle", "elevator", "aileron", "rudder", "flap")
    values = [s.row[name] for name in names]
    known = [value if math.isfinite(value) else 0.0 for value in values]
    active = sum(1 << k for k, value in enumerate(values) if math.isfinite(value))
    return {"time_usec": s.time_usec, "active": active, "actuator": known}


def hil_state_quaternion(s: Snapshot) -> Fields:
    """HIL_STATE_QUATERNION: the truth, with accelerations as an accelerometer feels them."""
    row = s.row
    north, east, up = ground_velocity(s)
    return {
        "time_usec": s.time_usec,
        "attitude_quaternion": quaternion(*s.attitude),
        **_angular_velocity(s),
        **_position(s),
        "alt": 1e3 * row["altitude"],
        "vx": 1e2 * north,
        "vy": 1e2 * east,
        "vz": -1e2 * up,
        "ind_airspeed": 0,
        "true_airspeed": 1e2 * row["airspeed"],
        "xacc": 1e3 * row["load_factor_x"],
        "yacc": 1e3 * row["load_factor_y"],
        "zacc": -1e3 * row["load_factor_z"],
    }


def wind_cov(s: Snapshot) -> Fields:
    """WIND_COV: the truth."""
    unknown = math.nan
    return {
        "time_usec": s.time_usec,
        "wind_x": s.row.get("wind_north", 0.0),
        "wind_y": s.row.get("wind_east", 0.0),
        "wind_z": -s.row.get("wind_up", 0.0),
        "var_horiz": unknown,
        "var_vert": unknown,
        "wind_alt": s.row["altitude"],
        "horiz_accuracy": unknown,
        "vert_accuracy": unknown,
    }
