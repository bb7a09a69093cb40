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
