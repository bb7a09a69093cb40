"""Set-points in flight as raw commands: ramps that the command filter then smooths."""

import math

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]


def ramp(start: float, target: float, rate: float, elapsed: Array) -> Array:
    """From `start` to `target` at `rate` a second, then held.

    Args:
        start, target: in the command's unit.
        rate: of change, positive, per second.
        elapsed: (rows,) [s] since `start`.
    """
    travel = np.minimum(rate * elapsed, abs(target - start))
    return start + math.copysign(1.0, target - start) * travel


def nearest_turn(target: float, heading: float) -> float:
    """`target` plus the whole turns that bring it nearest to `heading` [rad]."""
    return target + 2.0 * math.pi * round((heading - target) / (2.0 * math.pi))


def climb(
    height: float, start: float, steepest: float, rate: float, airspeed: Array, elapsed: Array
) -> Array:
    """Flight path command [rad] that gains `height` and ends level.

    Towards the steepest angle at `rate`, and back to level as soon as levelling gains the rest.

    Args:
        height: to be gained, negative to descend [m].
        start: flight path command now [rad].
        steepest: of the climb, positive [rad].
        rate: of the flight path, positive [rad/s].
        airspeed: (rows,) command [m/s].
        elapsed: (rows,) [s] since now, evenly spaced.

    Returns:
        (rows,).
    """
    dt = float(elapsed[1] - elapsed[0]) if elapsed.size > 1 else 0.0
    up = height > float(_levelling(np.array(start), airspeed[0], rate))
    path = ramp(start, steepest if up else -steepest, rate, elapsed)
    gained = np.cumsum(airspeed * np.sin(path)) * dt + _levelling(path, airspeed, rate)
    enough = np.flatnonzero(gained >= height if up else gained <= height)
    if enough.size:
        top = int(enough[0])
        path[top:] = ramp(float(path[top]), 0.0, rate, elapsed[top:] - elapsed[top])
    return path


def _levelling(path: Array, airspeed: Array, rate: float) -> Array:
    """Height [m] that is gained while the flight path goes back to level at `rate`."""
    return np.sign(path) * airspeed * (1.0 - np.cos(path)) / rate
