"""Altitude as a reference: the flight path command that reaches and holds it, whatever the air does.

Not in the paper, whose references are airspeed, flight path and heading. Altitude is closed in front of the
command filter, so that every loop flies it. A planned altitude goes to the commanded one, at a path angle and
a rate of the path that are given; the flight path command is its slope, corrected by the error of altitude and
by the air's own vertical motion, which altitude and flight path together show. Where the aircraft cannot
follow, the plan waits for it.
"""

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled
from ftc_jsb.vocabulary.kernel_types import Records, Row

ERROR_GAIN = 0.8  # [1/s], climb for an error of altitude
CAPTURE_GAIN = 0.5  # [1/s], of the plan on its last metres
WIND_FREQUENCY = 2.0  # [rad/s], of the estimate of altitude and vertical wind
WIND_DAMPING = 0.7
LEAD_MAX = 20.0  # [m] that the plan may be ahead of the aircraft
CORRECTION = math.radians(4.0)  # [rad], beyond the steepest path, against gusts

ALTITUDE_HOLD = np.dtype(
    [
        ("steepest", float),  # path to a new altitude [rad]
        ("path_rate", float),  # at which the path gets there [rad/s]
        ("lag", float),  # of the command filter [s]
        ("active", np.int64),
        ("planned", float),  # altitude [m]
        ("climb", float),  # its rate [m/s]
        ("altitude", float),  # estimate [m]
        ("wind", float),  # vertical, estimate [m/s]
        ("wind_rate", float),  # [m/s^2]
    ]
)


def altitude_hold(steepest: float, path_rate: float, lag: float) -> npt.NDArray[Any]:
    """(1,) ALTITUDE_HOLD that holds nothing yet.

    Args:
        steepest: path to a new altitude [rad].
        path_rate: at which the path gets there [rad/s].
        lag: of the command filter, 2 z / w [s].
    """
    hold = np.zeros(1, ALTITUDE_HOLD)
    hold["steepest"], hold["path_rate"], hold["lag"] = steepest, path_rate, lag
    return hold


@compiled
def hold_altitude(hold: Any, record: Records, i: int) -> None:
    """Write the flight path command of row `i + 1` where an altitude is commanded there.

    Args:
        hold: (1,) ALTITUDE_HOLD, advanced.
        record: (rows,) of the recording; measurements of row `i` and altitude command of row `i + 1` are read.
        i: row.
    """
    if i + 1 >= record.size:
        return
    h, row, after = hold[0], record[i], record[i + 1]
    if not math.isfinite(after.altitude_cmd_raw):
        h.active = 0
        return
    dt = after.time - row.time
    airspeed = row.airspeed_meas if math.isfinite(row.airspeed_meas) else row.airspeed_cmd_raw
    airspeed = max(airspeed, 1.0)
    path = row.flight_path_angle_meas
    if not math.isfinite(path):
        path = row.flight_path_angle_cmd_raw
    if h.active == 0:
        _start(h, row, after.altitude_cmd_raw, airspeed)
    _estimate(h, row.altitude_meas, airspeed * math.sin(path), dt)
    slope = (after.altitude_cmd_raw - row.altitude_cmd_raw) / dt  # [m/s], of the command
    slope = slope if math.isfinite(slope) else 0.0
    change = _plan(h, after.altitude_cmd_raw, slope, airspeed, dt)
    climb = h.climb + ERROR_GAIN * (h.planned - h.altitude) - h.wind
    climb += h.lag * (change - h.wind_rate)  # the command filter comes late
    most = math.sin(h.steepest + CORRECTION)
    after.flight_path_angle_cmd_raw = math.asin(min(max(climb / airspeed, -most), most))


@compiled
def plan_as_reference(hold: Any, filters: Any) -> None:
    """Where an altitude is held, the plan is the altitude of the path that the references make."""
    if hold[0].active == 1:
        filters[0].position[2] = hold[0].planned


@compiled
def _start(h: Any, row: Row, target: float, airspeed: float) -> None:
    """From where the aircraft is, the target [m] if nobody knows, on the path that is commanded now."""
    h.active = 1
    h.altitude = row.altitude_meas if math.isfinite(row.altitude_meas) else target
    h.planned = h.altitude
    h.climb = airspeed * math.sin(row.flight_path_angle_cmd_raw)
    h.wind, h.wind_rate = 0.0, 0.0


@compiled
def _estimate(h: Any, measured: float, climb: float, dt: float) -> None:
    """Altitude and vertical wind from altitude and the climb [m/s] through the air: observer of order 2."""
    error = measured - h.altitude if math.isfinite(measured) else 0.0
    h.altitude += dt * (climb + h.wind + 2.0 * WIND_DAMPING * WIND_FREQUENCY * error)
    h.wind_rate = WIND_FREQUENCY**2 * error
    h.wind += dt * h.wind_rate


@compiled
def _plan(h: Any, target: float, slope: float, airspeed: float, dt: float) -> float:
    """Advance the plan towards a target [m] that rises at `slope` [m/s]; the rate of its climb [m/s^2].

    The climb is proportional to what is left on the last metres, and its square root before, so that the path
    never bends faster than its rate.
    """
    bend = airspeed * h.path_rate  # [m/s^2]
    left = target - h.planned
    linear = bend / CAPTURE_GAIN**2  # [m], where proportional begins
    wanted = CAPTURE_GAIN * abs(left)
    if abs(left) > linear:
        wanted = math.sqrt(bend * (2.0 * abs(left) - linear))
    most = airspeed * math.sin(h.steepest)
    wanted = min(max(math.copysign(wanted, left) + slope, -most), most)
    before = h.climb
    h.climb += min(max(wanted - h.climb, -bend * dt), bend * dt)
    planned = h.planned + 0.5 * dt * (before + h.climb)
    h.planned = min(max(planned, h.altitude - LEAD_MAX), h.altitude + LEAD_MAX)
    return float((h.climb - before) / dt)
