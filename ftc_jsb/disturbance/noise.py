"""Random numbers that depend on nothing but seed, stream and count.

A sensor's noise at a sample is the same whatever else is drawn, in whatever order, and however the
flight is cut into stretches: flights are reproducible to the bit.
"""

import math

import numpy as np

from ftc_jsb.compiled import compiled

GOLDEN = np.uint64(0x9E3779B97F4A7C15)
FIRST = np.uint64(0xBF58476D1CE4E5B9)
SECOND = np.uint64(0x94D049BB133111EB)
STREAM = np.uint64(0xD1342543DE82EF95)


@compiled
def _mixed(value: np.uint64) -> np.uint64:
    """SplitMix64's finaliser (Steele, Lea and Flood 2014): every bit depends on every bit."""
    value = (value ^ (value >> np.uint64(30))) * FIRST
    value = (value ^ (value >> np.uint64(27))) * SECOND
    return value ^ (value >> np.uint64(31))


@compiled
def uniform(seed: int, stream: int, count: int) -> float:
    """Number in (0, 1): element `count` of a stream."""
    key = _mixed(np.uint64(seed) * GOLDEN + np.uint64(stream) * STREAM + GOLDEN)
    bits = _mixed(key + np.uint64(count) * GOLDEN)
    return (float(bits >> np.uint64(11)) + 0.5) * 2.0**-53


@compiled
def normal(seed: int, stream: int, count: int) -> float:
    """Standard normal number: element `count` of a stream (Box and Muller 1958)."""
    radius = math.sqrt(-2.0 * math.log(uniform(seed, stream, 2 * count)))
    return radius * math.cos(2.0 * math.pi * uniform(seed, stream, 2 * count + 1))
