"""The shipped cases fly: losses are told, and with FTC the error after them is far below that without."""

import numpy as np
import pytest

from ftc_jsb.runs.theory import analyse, fly_case, foresee
from ftc_jsb.theory.systems import CASES


@pytest.mark.parametrize(
    ("name", "index"), [("levitator", (2,)), ("reactor", (2,)), ("vessel", (2, 2, 2))]
)
def test_shipped_case_is_tracked_through_its_losses(name, index):
    """At the end each factor is known to 0.02, the RMS error of the worst output is at least five times as
    large without FTC, and the flight keeps the assumptions of the proof and stays below its bound.
    """
    analysis = analyse(CASES[name]())
    assert analysis.linearization.index == index
    expected = foresee(analysis)
    flown = {loop: fly_case(analysis, loop, 0, expected) for loop in ("ftc", "no-ftc")}
    history, proof = flown["ftc"].history, flown["ftc"].proof
    states = len(analysis.case.system.states)
    np.testing.assert_allclose(history.estimate[-1, states:], history.effectiveness[-1], atol=0.02)
    rms = {loop: np.sqrt((each.history.error**2).mean(axis=0)) for loop, each in flown.items()}
    places = np.cumsum([0, *index[:-1]])
    assert rms["ftc"][places].max() < 0.2 * rms["no-ftc"][places].max()
    assert proof.broken == ()
    assert proof.obeyed
