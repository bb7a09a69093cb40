"""The outer loop's own story in numbers: NAMED_VALUE_FLOAT and DEBUG_FLOAT_ARRAY."""

import math
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

from ftc_jsb.mavlink.telemetry.snapshot import Snapshot

Fields = dict[str, Any]


class Told(NamedTuple):
    """A number that is told under a name of at most ten capitals."""

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


STORY = (
    Told("EFF_THR", "1", "effectiveness of thrust, estimate", _column("effectiveness_thrust_est")),
    Told("EFF_THR_SD", "1", "its standard deviation", _column("effectiveness_thrust_std")),
    Told("EFF_THR_T", "1", "effectiveness of thrust, truth", _column("effectiveness_thrust")),
    Told("FAULT", "1", "1 while the detector declares a fault", _column("fault_declared")),
    Told("FAULT_STAT", "1", "detector statistic, above 1 declares", _column("fault_statistic")),
    Told("THR_CMD", "N", "thrust commanded", _column("thrust_cmd")),
    Told("THR", "N", "thrust delivered, truth", _column("thrust")),
    Told("NZ_CMD", "1", "load factor commanded", _column("load_factor_cmd")),
    Told("NZ", "1", "load factor, truth", _column("load_factor")),
    Told("BANK_CMD", "deg", "bank angle commanded", _degrees("bank_angle_cmd")),
    Told("BANK", "deg", "bank angle, truth", _degrees("bank_angle")),
    Told("TAS", "m/s", "true airspeed, truth", _column("airspeed")),
    Told("V_ERR", "m/s", "airspeed minus its reference", _error("airspeed")),
    Told("FPA_ERR", "deg", "flight path minus its reference", _error_degrees("flight_path_angle")),
    Told("HDG_ERR", "deg", "heading minus its reference", _error_degrees("heading")),
)  # fmt: skip
ARRAY_NAME = "FTC"
ARRAY_ID = 1


def named_value_float(s: Snapshot) -> Iterator[Fields]:
    """NAMED_VALUE_FLOAT: one for each number of STORY that this flight has."""
    for told in STORY:
        value = told.value(s.row)
        if math.isfinite(value):
            yield {"time_boot_ms": 1e3 * s.row["time"], "name": told.name, "value": value}


def debug_float_array(s: Snapshot) -> Fields:
    """DEBUG_FLOAT_ARRAY: STORY in its order; nan where this flight has none."""
    return {
        "time_usec": 1e6 * s.row["time"],
        "name": ARRAY_NAME,
        "array_id": ARRAY_ID,
        "data": [told.value(s.row) for told in STORY],
    }
