"""Where the knots of fitted tables stand."""

from collections.abc import Callable, Sequence

import numpy as np

from ftc_jsb.identify.regression import Array

MACH_STEP = 0.05
END_SHARE = 0.3  # of a step by which data must go beyond the last regular knot to get one more
COARSER = 1.25  # factor of the step where there are too many knots
BREAK_WIDTH = 0.002  # [-], half the distance of the knots of a break


def regular_knots(values: Array, step: float) -> Array:
    """Multiples of `step` inside the values' range (of 99.8 %), and none beyond it."""
    low, high = np.percentile(values, (0.1, 99.9))
    return np.arange(np.ceil(low / step), np.floor(high / step) + 1) * step


def knots_to_the_ends(values: Array, step: float) -> Array:
    """As `regular_knots`, with the ends of the values' range as first and last."""
    low, high = float(values.min()), float(values.max())
    inner = regular_knots(values, step)
    inner = inner[(inner > low + END_SHARE * step) & (inner < high - END_SHARE * step)]
    return np.concatenate([[low], inner, [high]])


def mach_knots(values: Array, breaks: Sequence[float], step: float = MACH_STEP) -> Array:
    """Mach knots, with a pair of them close to each Mach number at which flaps switch.

    Args:
        values: Mach numbers flown.
        breaks: Mach numbers at which flaps switch.
        step: between regular knots.
    """
    regular = regular_knots(values, step)
    low, high = np.percentile(values, (1.0, 99.0))
    if regular.size == 0:  # a range that is narrower than a step
        regular = np.array([low, high])
    ends = [low] if regular[0] - low > END_SHARE * step else []
    ends += [high] if high - regular[-1] > END_SHARE * step else []
    regular = np.sort(np.concatenate([regular, ends]))
    pairs = np.array([m + side * BREAK_WIDTH for m in breaks for side in (-1.0, 1.0)])
    near = [np.min(np.abs(m - pairs), initial=np.inf) for m in regular]
    return np.sort(np.concatenate([regular[np.array(near) > 2.0 * BREAK_WIDTH], pairs]))


def at_most(count: int, knots: Callable[[float], Array], step: float) -> Array:
    """Knots of a step, or of the smallest larger one with which there are no more than `count`.

    Args:
        count: that the kernels hold.
        knots: for a step.
        step: that is wanted.
    """
    found = knots(step)
    while len(found) > count:
        step *= COARSER
        found = knots(step)
    return found
