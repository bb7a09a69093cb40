"""The shipped cases fly: losses are told, and with FTC the error after them is far below that without."""

import numpy as np
import pytest

from ftc_jsb.theory.closed_loop import ClosedLoop
from ftc_jsb.theory.linearization import linearize
from ftc_jsb.theory.systems import CASES


@pytest.mark.parametrize(
    ("name", "index"), [("levitator", (2,)), ("reactor", (2,)), ("vessel", (2, 2, 2))]
)
def test_shipped_case_is_tracked_through_its_losses(name, index):
    """At the end each factor is known to 0.02, and the RMS error of the worst output is at least five times
    as large without FTC.
    """
    case = CASES[name]()
    linear = linearize(case.system)
    assert linear.index == index
    loop = ClosedLoop(linear, case.gains(linear))
    flown = {
        name: loop.fly(*case.task(linear), case.settings._replace(loop=name), case.conditions)
        for name in ("ftc", "no-ftc")
    }
    truth = flown["ftc"].effectiveness[-1]
    np.testing.assert_allclose(
        flown["ftc"].estimate[-1, len(case.system.states) :], truth, atol=0.02
    )
    rms = {name: np.sqrt((flight.error**2).mean(axis=0)) for name, flight in flown.items()}
    places = np.cumsum([0, *index[:-1]])
    assert rms["ftc"][places].max() < 0.2 * rms["no-ftc"][places].max()
