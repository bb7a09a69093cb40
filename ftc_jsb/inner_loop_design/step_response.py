"""A step response, measured: rise, overshoot, settling, error, and distance from the loop's own reference."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.inner_loop_design.step_commands import START
from ftc_jsb.six_dof.commanded_flight import DT

Array = npt.NDArray[np.float64]


class StepResponse(NamedTuple):
    """Numbers of a step response."""

    rise: float  # [s], 10 to 90 %
    overshoot: float  # of the step
    settling: float  # [s] until within 5 % for good
    error: float  # mean of the last second, of the step
    following: float  # RMS difference from the loop's own reference, of the step


def step_response(
    time: Array,
    value: Array,
    reference: Array,
    first: float,
    last: float,
) -> StepResponse:
    """Measure a step from `first` to `last` at START.

    Args:
        time: (samples,) [s], DT apart.
        value: (samples,) of what is stepped.
        reference: (samples,) that the loop's reference model makes of the step.
        first: value before the step.
        last: value after it.
    """
    share = (value - first) / (last - first)
    after = time >= START
    reached = [
        time[np.argmax(share > level)] if (share > level).any() else math.inf
        for level in (0.1, 0.9)
    ]
    outside = np.flatnonzero(np.abs(share - 1.0) > 0.05)
    settled = time[outside[-1]] + DT - START if outside.size else 0.0
    return StepResponse(
        rise=float(reached[1] - reached[0]),
        overshoot=float(max(share.max() - 1.0, 0.0)),
        settling=float(settled),
        error=float(abs(share[-round(1.0 / DT) :].mean() - 1.0)),
        following=float(np.sqrt(np.mean(((value - reference)[after] / (last - first)) ** 2))),
    )
