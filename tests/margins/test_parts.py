"""Crossings, stability limit and input perturbation on loops that are known beforehand."""

import numpy as np
import pytest

from ftc_jsb.margins.classical import classical_margins
from ftc_jsb.margins.frequency_response import (
    FrequencyResponse,
    harmonics,
    loop_response,
    multisine,
)
from ftc_jsb.margins.input_perturbation import Delay, Gain, Injection, PerturbedPlant
from ftc_jsb.margins.stability_limit import diverges, smallest_divergent

FREQUENCY = np.geomspace(0.05, 50.0, 120)
TIME = np.arange(0.0, 30.0, 0.01)


def response(loop: np.ndarray) -> FrequencyResponse:
    return FrequencyResponse(FREQUENCY, loop, np.ones(FREQUENCY.size))


def test_textbook_margins():
    """L = 4 / (s (s + 1) (s + 2)): gain 1.5 at sqrt(2) rad/s; phase from |L| = 1 solved numerically."""
    s = 1j * FREQUENCY
    found = classical_margins(response(4.0 / (s * (s + 1.0) * (s + 2.0))))
    assert found.gain == pytest.approx(1.5, rel=0.005)
    assert found.phase_crossover == pytest.approx(np.sqrt(2.0), rel=0.005)
    roots = np.roots([1.0, 0.0, 5.0, 0.0, 4.0, 0.0, -16.0])  # w^2 (w^2 + 1) (w^2 + 4) = 16
    w = float(max(root.real for root in roots if abs(root.imag) < 1e-9))
    phase = np.pi / 2.0 - np.arctan(w) - np.arctan(w / 2.0)
    assert found.gain_crossover == pytest.approx(w, rel=0.002)
    assert found.phase == pytest.approx(phase, abs=0.005)
    assert found.delay == pytest.approx(phase / w, rel=0.02)
    assert found.gain_down == 0.0


def test_conditionally_stable_loop_has_a_lower_gain_margin():
    """Three integrators and two zeros, 10 (s + 1)^2 / s^3: fails when its gain falls below 0.05."""
    s = 1j * FREQUENCY
    found = classical_margins(response(10.0 * (s + 1.0) ** 2 / s**3))
    assert found.gain == np.inf
    assert found.gain_down == pytest.approx(0.05, rel=0.005)


def test_loop_that_never_reaches_1_has_no_phase_margin():
    found = classical_margins(response(0.5 / (1j * FREQUENCY + 1.0)))
    assert (found.gain, found.phase, found.delay) == (np.inf, np.inf, np.inf)
    assert np.isnan(found.gain_crossover)


def test_multisine_has_its_lines_only():
    lines = harmonics(1000, 1, 30)
    assert lines[0] == 1
    assert lines[-1] == 500
    signal = multisine(1000, lines, 2.0, 7)
    assert np.sqrt(np.mean(signal**2)) == pytest.approx(2.0)
    size = np.abs(np.fft.rfft(signal))
    assert np.abs(np.delete(size, lines)).max() < 1e-9 * size.max()
    assert np.ptp(size[lines[:-1]]) < 1e-9 * size.max()
    assert not np.array_equal(signal, multisine(1000, lines, 2.0, 8))


def test_loop_response_sees_through_drift_and_tells_what_is_not_linear():
    """Minus half of what is given: exact in spite of a drift; with a cube of w in v the coherence falls."""
    lines = harmonics(1000, 1, 30)
    given = np.stack([np.tile(multisine(1000, lines, 1.0, k), 2) for k in range(4)])
    drift = 0.003 * np.arange(2000)
    found = loop_response(-0.5 * given + drift, given, lines, 0.01)
    np.testing.assert_allclose(found.loop, 0.5, atol=1e-9)
    np.testing.assert_allclose(found.coherence, 1.0, atol=1e-9)
    bent = loop_response(-0.5 * given + 0.3 * given**3, given, lines, 0.01)
    assert bent.coherence.min() < 0.9


@pytest.mark.parametrize(
    ("growth", "size", "says"),
    [(-0.05, 1.0, False), (0.02, 1.0, True), (-0.05, 200.0, True), (0.05, 1e-5, False)],
    ids=["decays", "grows", "limit cycle", "below 1 % of the step"],
)
def test_what_breaks_means(growth, size, says):
    """Oscillations of 2 rad/s after a step of 1, on a trend, which counts for nothing."""
    signal = 3.0 + 0.1 * TIME + size * np.exp(growth * TIME) * np.cos(2.0 * TIME)
    assert diverges(signal, 1.0, complete=True) == says
    assert diverges(signal, 1.0, complete=False)
    assert diverges(np.where(TIME > 20.0, np.nan, signal), 1.0, complete=True)


def test_search_for_the_stability_limit():
    tried = []

    def broken(value: float) -> bool:
        tried.append(value)
        return value > 37.0

    assert smallest_divergent(broken, 1.05, 1000.0) == pytest.approx(37.0, rel=0.005)
    assert len(tried) < 22
    assert smallest_divergent(lambda value: False, 1.05, 1000.0) == np.inf


class Echo:
    """A plant that notes what it is given."""

    def __init__(self) -> None:
        self.flown: list[float] = []

    def reset(self, record):
        self.record = record

    def truth(self, i):
        pass

    def step(self, i):
        self.flown.append(float(self.record["thrust_cmd"][i]))

    def close(self):
        pass


@pytest.mark.parametrize(
    ("alter", "expected"),
    [
        (Injection(np.arange(6.0)), [10, 21, 32, 43, 54, 65]),
        (Gain(2.0, 2, 1.0), [10, 20, 41, 61, 81, 101]),  # about 20, the command before
        (Delay(1.0, 2, 0.5), [10, 20, 20.5, 30.5, 40.5, 50.5]),
        (Delay(0.5, 2, 0.0), [10, 20, 25, 35, 45, 55]),
    ],
    ids=["injection", "gain", "delay", "half a sample"],
)
def test_recording_keeps_what_the_loop_commanded(alter, expected):
    """The plant is given the perturbed command; the recording is as it was."""
    record = np.zeros(6, [("thrust_cmd", float)])
    record["thrust_cmd"] = commands = np.arange(10.0, 70.0, 10.0)
    plant = PerturbedPlant(echo := Echo(), "thrust", alter)
    plant.reset(record)
    for i in range(6):
        plant.step(i)
    np.testing.assert_allclose(echo.flown, expected)
    np.testing.assert_allclose(plant.given, expected)
    np.testing.assert_array_equal(record["thrust_cmd"], commands)
