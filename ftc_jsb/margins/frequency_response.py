"""Random-phase multisines, and the loop's frequency response from flights that they were injected in."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Complex = npt.NDArray[np.complex128]


class FrequencyResponse(NamedTuple):
    """Frequency response of the broken loop L, with negative feedback: 1 + L = 0 is the stability limit."""

    frequency: Array  # [rad/s], increasing
    loop: Complex
    coherence: Array  # 0..1


def harmonics(samples: int, first: int, lines: int) -> npt.NDArray[np.int64]:
    """Harmonics of a period, evenly spaced on a log scale, up to Nyquist's, where L is real.

    Args:
        samples: of the period, even.
        first: lowest harmonic.
        lines: how many to aim at; where they would fall together there are fewer.
    """
    return np.unique(np.round(np.geomspace(first, samples // 2, lines)).astype(np.int64))


def multisine(samples: int, lines: npt.NDArray[np.int64], rms: float, seed: int) -> Array:
    """One period of a sum of cosines of equal size and random phase.

    Args:
        samples: of the period.
        lines: harmonics.
        rms: of the sum.
        seed: of the phases.
    """
    phase = np.random.default_rng(seed).uniform(0.0, 2.0 * np.pi, lines.size)
    spectrum = np.zeros(samples // 2 + 1, dtype=complex)
    spectrum[lines] = np.exp(1j * phase)
    spectrum[-1] = np.sign(spectrum[-1].real)  # Nyquist's has no phase
    signal: Array = np.fft.irfft(spectrum, samples)
    signal *= rms / np.sqrt(np.mean(signal**2))
    return signal


def loop_response(
    before: Array, after: Array, lines: npt.NDArray[np.int64], dt: float
) -> FrequencyResponse:
    """L = -(signal before the injection) / (signal after it), averaged over flights.

    The loop stays closed in flight and is opened by this quotient alone. Other phases in each
    flight make what is not linear incoherent, which averaging over periods of one flight would not.

    Args:
        before: (flights, 2 periods), what the loop commanded, once settled.
        after: (flights, 2 periods), what the plant was given.
        lines: harmonics that were injected.
        dt: sample time [s].
    """
    samples = before.shape[1] // 2
    v, w = (np.fft.rfft(_without_drift(signal), axis=1)[:, lines] for signal in (before, after))
    cross = np.sum(v * np.conj(w), axis=0)
    power_v, power_w = np.sum(np.abs(v) ** 2, axis=0), np.sum(np.abs(w) ** 2, axis=0)
    coherence = np.abs(cross) ** 2 / (power_v * power_w)
    return FrequencyResponse(2.0 * np.pi * lines / (samples * dt), -cross / power_w, coherence)


def _without_drift(signals: Array) -> Array:
    """The second period, less its mean and the drift that the first tells it from."""
    samples = signals.shape[1] // 2
    first, second = signals[:, :samples], signals[:, samples:]
    drift = np.mean(second - first, axis=1, keepdims=True)  # a period
    still: Array = second - drift * np.arange(samples) / samples
    still -= still.mean(axis=1, keepdims=True)
    return still
