"""Gain, phase and delay margins of a frequency response."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.margins.frequency_response import FrequencyResponse

Array = npt.NDArray[np.float64]


class ClassicalMargins(NamedTuple):
    """Margins with the frequencies [rad/s] that they are at; inf and nan where there is no crossing."""

    gain: float  # factor > 1 that the loop bears
    phase_crossover: float
    gain_down: float  # factor < 1 below which it fails; 0 if it bears all
    phase: float  # [rad], of lag
    gain_crossover: float  # of the smallest phase margin
    delay: float  # [s]
    coherence: float  # the least of the lines beside the crossings


def classical_margins(response: FrequencyResponse) -> ClassicalMargins:
    """Every crossing of -180 deg and of size 1, the worst of each kind.

    Between lines, log |L| and the phase are linear in log frequency.

    Args:
        response: dense enough for the phase to turn by less than 180 deg from line to line.
    """
    frequency, size = np.log(response.frequency), np.log(np.abs(response.loop))
    phase = np.unwrap(np.angle(response.loop))
    gain, at_phase, down, coherence = np.inf, np.nan, 0.0, 1.0
    for k, part in _half_turns(phase):
        level = float(np.exp(-_between(size, k, part)))
        if 1.0 < level < gain:
            gain, at_phase = level, float(np.exp(_between(frequency, k, part)))
        elif down < level <= 1.0:
            down = level
        coherence = min(coherence, *response.coherence[k : k + 2])
    smallest, at_gain, delay = np.inf, np.nan, np.inf
    for k, part in _crossings(size):
        omega = float(np.exp(_between(frequency, k, part)))
        lag = float(np.mod(_between(phase, k, part) + np.pi, 2.0 * np.pi))
        delay = min(delay, lag / omega)
        if abs(signed := float(np.angle(np.exp(1j * lag)))) < abs(smallest):
            smallest, at_gain = signed, omega
        coherence = min(coherence, *response.coherence[k : k + 2])
    return ClassicalMargins(gain, at_phase, down, smallest, at_gain, delay, float(coherence))


def _half_turns(phase: Array) -> list[tuple[int, float]]:
    """Crossings of -180 deg, and of whole turns from there."""
    turns = (phase + np.pi) / (2.0 * np.pi)
    levels = range(math.floor(turns.min()), math.ceil(turns.max()) + 1)
    return sorted(crossing for level in levels for crossing in _crossings(turns - level))


def _crossings(values: Array) -> list[tuple[int, float]]:
    """Index before each change of sign, and where between it and the next, 0..1."""
    above = values > 1e-9  # L is real at Nyquist: rounding is no side
    found = np.flatnonzero(above[:-1] != above[1:])
    return [(int(k), float(values[k] / (values[k] - values[k + 1]))) for k in found]


def _between(values: Array, k: int, part: float) -> float:
    return float((1.0 - part) * values[k] + part * values[k + 1])
