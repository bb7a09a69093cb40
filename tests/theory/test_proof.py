"""The proof on the general loop: a flight that obeys, one against the assumptions, one against V."""

import numpy as np
import pytest

from ftc_jsb.theory.closed_loop import ClosedLoop, Conditions, Settings
from ftc_jsb.theory.constants import proof_constants
from ftc_jsb.theory.gains import placed_gains
from ftc_jsb.theory.linearization import linearize
from ftc_jsb.theory.proof import Task, expect, fly_and_prove
from ftc_jsb.theory.systems import textbook_plant

SETTINGS = Settings(
    0.005, 50.0, np.array([1e-10, 1e-10, 1e-6]), np.array([1e-8]), np.array([1e-6, 1e-6, 1e-4])
)
TASK = Task(
    lambda t: (np.array([0.5 * np.sin(t), 0.5 * np.cos(t)]), np.array([-0.5 * np.sin(t)])),
    lambda t: np.array([0.8 if t >= 5.0 else 1.0]),
    np.array([0.0, 0.5]),
    np.array([0.0]),
    12.0,
)


@pytest.fixture(scope="module")
def loop():
    linear = linearize(textbook_plant())
    a, b, _ = linear.brunovsky()
    return ClosedLoop(linear, placed_gains(a, b, np.array([-2.0, -3.0])))


@pytest.fixture(scope="module")
def known(loop):
    constants = proof_constants(loop.linearization)
    assert constants.certified
    return constants, expect(loop, TASK, SETTINGS)


def test_flight_obeys_its_prediction(loop, known):
    _, proof = fly_and_prove(loop, TASK, SETTINGS, known=known)
    assert proof.broken == ()
    assert proof.obeyed
    assert np.all(proof.predicted_each.max(axis=0) <= proof.predicted.max())


def test_flights_that_do_not_obey_are_named(loop, known):
    """A fault of the sensor that no one declared breaks the bound of x~; a slow actuator that of V as well."""
    bias = Conditions(sensor=lambda t: np.array([2e-3 if t > 8.0 else 0.0]))
    _, biased = fly_and_prove(loop, TASK, SETTINGS, bias, known)
    assert any("the estimate errs by more than assumed at 8.0" in words for words in biased.broken)
    _, slow = fly_and_prove(loop, TASK, SETTINGS, Conditions(lag=np.array([0.1])), known)
    assert not slow.below
