"""Messages about the vehicle itself: heartbeat, health, home, clocks, version."""

import math

from pymavlink.dialects.v20 import common as dialect

import ftc_jsb
from ftc_jsb.mavlink.link.message_fields import UNKNOWN_16, Fields
from ftc_jsb.mavlink.telemetry.quaternion import quaternion
from ftc_jsb.mavlink.telemetry.snapshot import Phase, Snapshot

CUSTOM_MODE = 15  # what MAVProxy calls GUIDED on a plane: the flight follows set-points
MODE = (
    dialect.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED
    | dialect.MAV_MODE_FLAG_GUIDED_ENABLED
    | dialect.MAV_MODE_FLAG_STABILIZE_ENABLED
    | dialect.MAV_MODE_FLAG_MANUAL_INPUT_ENABLED
)
ARMED = dialect.MAV_MODE_FLAG_SAFETY_ARMED
SENSORS = (
    dialect.MAV_SYS_STATUS_SENSOR_3D_GYRO
    | dialect.MAV_SYS_STATUS_SENSOR_3D_ACCEL
    | dialect.MAV_SYS_STATUS_SENSOR_3D_MAG
    | dialect.MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE
    | dialect.MAV_SYS_STATUS_SENSOR_DIFFERENTIAL_PRESSURE
    | dialect.MAV_SYS_STATUS_SENSOR_GPS
    | dialect.MAV_SYS_STATUS_SENSOR_ATTITUDE_STABILIZATION
    | dialect.MAV_SYS_STATUS_AHRS
    | dialect.MAV_SYS_STATUS_PREARM_CHECK
)
# What each sensor is judged by: while one of its signals is silent or excluded, it is unhealthy.
SIGNALS_OF = {
    dialect.MAV_SYS_STATUS_SENSOR_3D_GYRO: ("roll_rate", "pitch_rate", "yaw_rate"),
    dialect.MAV_SYS_STATUS_SENSOR_3D_ACCEL: ("load_factor_x", "load_factor_y", "load_factor_z"),
    dialect.MAV_SYS_STATUS_SENSOR_3D_MAG: ("yaw",),
    dialect.MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE: ("altitude",),
    dialect.MAV_SYS_STATUS_SENSOR_DIFFERENTIAL_PRESSURE: ("airspeed",),
    dialect.MAV_SYS_STATUS_SENSOR_GPS: ("north", "east"),
    dialect.MAV_SYS_STATUS_AHRS: ("roll", "pitch", "yaw"),
}
ENGINE = dialect.MAV_SYS_STATUS_SENSOR_PROPULSION
STATES = {
    Phase.WAITING: dialect.MAV_STATE_BOOT,
    Phase.FLYING: dialect.MAV_STATE_ACTIVE,
    Phase.PAUSED: dialect.MAV_STATE_ACTIVE,
    Phase.OVER: dialect.MAV_STATE_STANDBY,
    Phase.LOST: dialect.MAV_STATE_FLIGHT_TERMINATION,
}
CAPABILITIES = (
    dialect.MAV_PROTOCOL_CAPABILITY_PARAM_FLOAT
    | dialect.MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_C_CAST
    | dialect.MAV_PROTOCOL_CAPABILITY_COMMAND_INT
    | dialect.MAV_PROTOCOL_CAPABILITY_FLIGHT_TERMINATION
    | dialect.MAV_PROTOCOL_CAPABILITY_MAVLINK2
)


def heartbeat(s: Snapshot) -> Fields:
    """HEARTBEAT: a fixed wing, armed while it flies; critical while a limit is broken or control lost."""
    in_danger = s.in_flight and s.critical
    return {
        "type": dialect.MAV_TYPE_FIXED_WING,
        "autopilot": dialect.MAV_AUTOPILOT_GENERIC,
        "base_mode": MODE | (ARMED if s.in_flight else 0),
        "custom_mode": CUSTOM_MODE,
        "system_status": dialect.MAV_STATE_CRITICAL if in_danger else STATES[s.phase],
        "mavlink_version": 3,
    }


def sys_status(s: Snapshot) -> Fields:
    """SYS_STATUS: propulsion is unhealthy while a fault is declared, a sensor while silent or excluded.

    The link's counters stand in the fields of errors.
    """
    failed = sum(bit for bit, names in SIGNALS_OF.items() if s.failed(*names))
    no_fault = s.row.get("fault_declared", 0.0) < 0.5
    return {
        "onboard_control_sensors_present": SENSORS | ENGINE,
        "onboard_control_sensors_enabled": SENSORS | ENGINE,
        "onboard_control_sensors_health": SENSORS & ~failed | (ENGINE if no_fault else 0),
        "load": min(max(1000.0 * s.health.load, 0.0), 1000.0),
        "voltage_battery": UNKNOWN_16,
        "current_battery": -1,
        "battery_remaining": -1,
        "errors_comm": s.health.refused % 2**16,
        "errors_count1": s.health.overruns % 2**16,
        "errors_count2": s.health.clamped % 2**16,
        "errors_count3": s.health.unsent % 2**16,
    }


def system_time(s: Snapshot) -> Fields:
    """SYSTEM_TIME: the wall clock, and the time of flight."""
    return {"time_unix_usec": 1e6 * s.unix, "time_boot_ms": s.time_boot_ms}


def extended_sys_state(s: Snapshot) -> Fields:
    """EXTENDED_SYS_STATE: in the air while it flies."""
    in_air = dialect.MAV_LANDED_STATE_IN_AIR
    undefined = dialect.MAV_LANDED_STATE_UNDEFINED
    return {"landed_state": in_air if s.in_flight else undefined}


def home_position(s: Snapshot) -> Fields:
    """HOME_POSITION: the scenario's origin, at sea level."""
    return {
        "latitude": 1e7 * s.origin[0],
        "longitude": 1e7 * s.origin[1],
        "altitude": 0,
        "q": quaternion(0.0, 0.0, 0.0),
        "approach_x": math.nan,
        "approach_y": math.nan,
        "approach_z": math.nan,
        "time_usec": s.time_usec,
    }


def autopilot_version() -> Fields:
    """AUTOPILOT_VERSION: capabilities, and the version of this program as 0xMMmmpp00."""
    numbers = [int(part) for part in ftc_jsb.__version__.split(".")[:3] if part.isdecimal()]
    major, minor, patch = (*numbers, 0, 0, 0)[:3]
    version = major << 24 | minor << 16 | patch << 8
    return {
        "capabilities": CAPABILITIES,
        "flight_sw_version": version,
        "flight_custom_version": [0] * 8,
        "middleware_custom_version": [0] * 8,
        "os_custom_version": [0] * 8,
        "uid2": [0] * 18,
    }
