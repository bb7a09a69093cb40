"""Gain, phase and delay margins of a frequency response."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.margins.multisine import Response

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


def classical_margins(response: Response) -> ClassicalMargins:
    """Every crossing of -180 deg and of 1, the worst of each kind.

    Between lines, log |L| and the phase are linear in log frequency. The phase is continuous from
    the lowest line on, which lies in (-270 deg, 90 deg].

    Args:
        response: dense enough for the phase to turn by less than 180 deg from line to line.
    """
    frequency = np.log(response.frequency)
    size = np.log(np.abs(response.loop))
    phase = np.unwrap(np.angle(response.loop))
    phase += (
        2.0
        * np.pi
        * (np.ceil((phase[0] - 0.5 * np.pi) / (-2.0 * np.pi)) if phase[0] > 0.5 * np.pi else 0)
    )
    gain, at_phase, down, coherent = np.inf, np.nan, 0.0, 1.0
    turns = np.arange(
        np.floor((phase.min() + np.pi) / (2 * np.pi)),
        np.ceil((phase.max() + np.pi) / (2 * np.pi)) + 1,
    )
    for turn in turns:
        for k, part in _crossings(phase + np.pi - 2.0 * np.pi * turn):
            level = float(np.exp(-_between(size, k, part)))
            if 1.0 < level < gain:
                gain, at_phase = level, float(np.exp(_between(frequency, k, part)))
                coherent = min(coherent, *response.coherence[k : k + 2])
            elif down < level <= 1.0:
                down = level
    smallest, at_gain, delay = np.inf, np.nan, np.inf
    for k, part in _crossings(size):
        omega = float(np.exp(_between(frequency, k, part)))
        margin = _between(phase, k, part) + np.pi
        lag = float(np.mod(margin, 2.0 * np.pi))
        delay = min(delay, lag / omega)
        coherent = min(coherent, *response.coherence[k : k + 2])
        signed = lag if lag <= np.pi else lag - 2.0 * np.pi
        if abs(signed) < abs(smallest):
            smallest, at_gain = signed, omega
    return ClassicalMargins(gain, at_phase, down, smallest, at_gain, delay, float(coherent))


def _crossings(values: Array) -> list[tuple[int, float]]:
    """Index before each change of sign, and where between it and the next."""
    before, after = values[:-1], values[1:]
    found = np.flatnonzero((before > 0.0) != (after > 0.0))
    return [(int(k), float(before[k] / (before[k] - after[k]))) for k in found]


def _between(values: Array, k: int, part: float) -> float:
    return float((1.0 - part) * values[k] + part * values[k + 1])
