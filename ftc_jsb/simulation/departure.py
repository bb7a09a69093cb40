"""Ends a flight that has departed: what the kernels cannot fly on from, and why."""

import math

from ftc_jsb.compiled import compiled
from ftc_jsb.vocabulary.kernel_types import Records

FLYING, NOT_FINITE, STOPPED, VERTICAL, STALLED, GROUND, DRY = range(7)

LEAST_FUEL = 0.5  # [kg]: what is left when JSBSim's engines starve

REASONS = {
    NOT_FINITE: "the state or a command is no longer finite",
    STOPPED: "airspeed below 30 m/s",
    VERTICAL: "flight path steeper than 85 deg, where (41) is singular",
    STALLED: "angle of attack beyond 60 deg",
    GROUND: "altitude below sea level",
    DRY: "no fuel is left",
}


@compiled
def departed(record: Records, i: int) -> int:
    """FLYING, or the reason why row `i` cannot be flown on from."""
    row = record[i]
    total = row.airspeed + row.flight_path_angle + row.heading + row.altitude + row.load_factor
    if not math.isfinite(total + row.bank_angle + row.thrust):
        return NOT_FINITE
    if i > 0:
        before = record[i - 1]
        if not math.isfinite(before.thrust_cmd + before.load_factor_cmd + before.bank_angle_cmd):
            return NOT_FINITE
    if row.airspeed < 30.0:  # [m/s]
        return STOPPED
    if abs(row.flight_path_angle) > math.radians(85.0):
        return VERTICAL
    if abs(row.alpha) > math.radians(60.0):
        return STALLED
    if row.altitude < 0.0:
        return GROUND
    if row.fuel < LEAST_FUEL:  # nan, and so never, where none is burnt
        return DRY
    return FLYING
