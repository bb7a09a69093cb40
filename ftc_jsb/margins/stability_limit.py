"""Gain and delay raised until the loop breaks: what breaks means, and the search for it."""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

QUIET = 0.01  # of the step: what moves less at the end has settled
GROWN = 10.0  # steps: beyond, limits may have stopped the growth
SCAN = 1.4  # factor from one trial to the next, until the first one breaks
RESOLUTION = 0.005  # of the limit, where the bisection ends


def diverges(given: Array, step: float, complete: bool) -> bool:
    """Whether what the plant was given after a step grows.

    The time after the step is cut in three. The loop breaks if the flight did not come to its end,
    or if the last third moves about its own line (mean and trend) more than the middle third does
    about its, and by more than 1 % of the step; or if either moves by more than ten steps: it has
    grown into what limits it.

    Args:
        given: to the plant, from the step on.
        step: its size.
        complete: whether the flight came to its end.
    """
    if not complete or not np.isfinite(given).all():
        return True
    third = given.size // 3
    middle, last = (_movement(given[k * third : (k + 1) * third]) for k in (1, 2))
    grown = max(middle, last) > GROWN * abs(step)
    return grown or (last > middle and last > QUIET * abs(step))


def _movement(signal: Array) -> float:
    """RMS about mean and linear trend."""
    ramp = np.linspace(-1.0, 1.0, signal.size)
    rest = signal - signal.mean()
    rest = rest - ramp * float(rest @ ramp / (ramp @ ramp))
    return float(np.sqrt(np.mean(rest**2)))


def smallest_divergent(broken: Callable[[float], bool], first: float, most: float) -> float:
    """The smallest value at which a loop breaks: a scan upwards, then bisection on a log scale.

    Args:
        broken: whether the loop breaks at a value.
        first: value to begin with; the loop holds below it.
        most: where the scan ends.

    Returns:
        The limit to 0.5 %; inf if there is none up to `most`; `first` if it is broken there.
    """
    good, bad = first, first
    while not broken(bad):
        good, bad = bad, bad * SCAN
        if good >= most:
            return np.inf
    while bad > good * (1.0 + RESOLUTION):
        middle = float(np.sqrt(good * bad))
        if broken(middle):
            bad = middle
        else:
            good = middle
    return float(np.sqrt(good * bad))
