"""When a fault is declared and withdrawn."""

import numpy as np

from ftc_jsb.estimation.detector import DETECTOR, detect


def declared(estimates, deviation=0.0):
    """Verdict after each sample at 100 Hz with margin 0.1, 4 sigmas, held for 0.2 s."""
    detector = np.zeros(1, DETECTOR)
    verdicts = []
    for estimate in estimates:
        detect(detector[0], estimate, deviation, 0.1, 4.0, 0.2, 0.01)
        verdicts.append(int(detector[0]["declared"]))
    return verdicts


def test_loss_beyond_the_margin_is_declared_after_the_hold():
    verdicts = declared([1.0] * 10 + [0.6] * 40)
    assert verdicts.index(1) in (29, 30)  # 20 samples of 0.01 s, rounding either way
    assert all(verdicts[30:])


def test_loss_within_the_margin_or_shorter_than_the_hold_is_not():
    assert not any(declared([0.91] * 1000))
    assert not any(declared(([0.6] * 15 + [1.0]) * 50))


def test_uncertain_loss_is_not_declared():
    """0.6 with a standard deviation of 0.1 is within 4 sigmas of the margin."""
    assert not any(declared([0.6] * 1000, deviation=0.1))


def test_recovery_withdraws_and_a_loss_near_the_threshold_does_not_chatter():
    verdicts = declared([0.6] * 50 + [1.0] * 50)
    assert verdicts[40] == 1
    assert verdicts[-1] == 0
    near = 0.9 + 0.005 * np.sin(np.arange(2000) / 40.0)
    assert np.sum(np.diff(declared([0.6] * 30 + list(near))) != 0) == 1
