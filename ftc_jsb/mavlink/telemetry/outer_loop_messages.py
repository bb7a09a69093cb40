"""The outer loop in numbers, estimates and errors: NAMED_VALUE_FLOAT and DEBUG_FLOAT_ARRAY."""

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.link.message_fields import Fields
from ftc_jsb.mavlink.telemetry.snapshot import Snapshot


class NamedValue(NamedTuple):
    """A number that is sent under a name of at most ten capitals."""

    name: str
    unit: str
    meaning: str
    value: Callable[[dict[str, float]], float]


def _column(name: str) -> Callable[[dict[str, float]], float]:
    return lambda row: row[name]


def _degrees(name: str) -> Callable[[dict[str, float]], float]:
    return lambda row: math.degrees(row[name])


def _error(name: str) -> Callable[[dict[str, float]], float]:
    return lambda row: row[name] - row[f"{name}_ref"]


def _error_degrees(name: str) -> Callable[[dict[str, float]], float]:
    return lambda row: math.degrees(row[name] - row[f"{name}_ref"])


OUTER_LOOP_VALUES = (
    NamedValue("EFF_THR", "1", "effectiveness of thrust, estimate", _column("effectiveness_thrust_est")),
    NamedValue("EFF_THR_SD", "1", "its standard deviation", _column("effectiveness_thrust_std")),
    NamedValue("EFF_THR_T", "1", "effectiveness of thrust, truth", _column("effectiveness_thrust")),
    NamedValue("FAULT", "1", "1 while the detector declares a fault", _column("fault_declared")),
    NamedValue("FAULT_STAT", "1", "detector statistic, above 1 declares", _column("fault_statistic")),
    NamedValue("THR_CMD", "N", "thrust commanded", _column("thrust_cmd")),
    NamedValue("THR", "N", "thrust delivered, truth", _column("thrust")),
    NamedValue("NZ_CMD", "1", "load factor commanded", _column("load_factor_cmd")),
    NamedValue("NZ", "1", "load factor, truth", _column("load_factor")),
    NamedValue("BANK_CMD", "deg", "bank angle commanded", _degrees("bank_angle_cmd")),
    NamedValue("BANK", "deg", "bank angle, truth", _degrees("bank_angle")),
    NamedValue("TAS", "m/s", "true airspeed, truth", _column("airspeed")),
    NamedValue("V_ERR", "m/s", "airspeed minus its reference", _error("airspeed")),
    NamedValue("FPA_ERR", "deg", "flight path minus its reference", _error_degrees("flight_path_angle")),
    NamedValue("HDG_ERR", "deg", "heading minus its reference", _error_degrees("heading")),
    NamedValue("TAS_M", "m/s", "true airspeed, measured", _column("airspeed_meas")),
    NamedValue("ALT_M", "m", "altitude, measured", _column("altitude_meas")),
    NamedValue("CLIMB_LOST", "deg", "path angle given up for want of thrust", _degrees("climb_given_up")),
    NamedValue("TURN_LOST", "deg/s", "turn rate given up for want of thrust", _degrees("turn_given_up")),
)  # fmt: skip
ARRAY_NAME = "FTC"
ARRAY_ID = 1


GATE = 3.0  # standard deviations of an innovation at which its ratio is 1


def estimator_status(s: Snapshot) -> Fields:
    """ESTIMATOR_STATUS: innovations over 3 of their standard deviations; nan where nothing is estimated."""
    ratios = {name: _ratio(s, name) for name in ("airspeed", "flight_path_angle", "heading")}
    unknown = math.nan
    there = math.isfinite(ratios["airspeed"])
    velocity = dialect.ESTIMATOR_VELOCITY_HORIZ | dialect.ESTIMATOR_VELOCITY_VERT
    return {
        "time_usec": s.time_usec,
        "flags": velocity if there else 0,
        "vel_ratio": ratios["flight_path_angle"],
        "pos_horiz_ratio": unknown,
        "pos_vert_ratio": unknown,
        "mag_ratio": ratios["heading"],
        "hagl_ratio": unknown,
        "tas_ratio": ratios["airspeed"],
        "pos_horiz_accuracy": unknown,
        "pos_vert_accuracy": unknown,
    }


def _ratio(s: Snapshot, name: str) -> float:
    innovation, deviation = s.row[f"{name}_innovation"], s.row[f"{name}_innovation_std"]
    return abs(innovation) / (GATE * deviation) if deviation > 0.0 else math.nan


def named_value_float(s: Snapshot) -> Iterator[Fields]:
    """NAMED_VALUE_FLOAT: one for each number of OUTER_LOOP_VALUES that this flight has."""
    for named in OUTER_LOOP_VALUES:
        value = named.value(s.row)
        if math.isfinite(value):
            yield {"time_boot_ms": s.time_boot_ms, "name": named.name, "value": value}


def debug_float_array(s: Snapshot) -> Fields:
    """DEBUG_FLOAT_ARRAY: OUTER_LOOP_VALUES in its order; nan where this flight has none."""
    return {
        "time_usec": s.time_usec,
        "name": ARRAY_NAME,
        "array_id": ARRAY_ID,
        "data": [named.value(s.row) for named in OUTER_LOOP_VALUES],
    }
