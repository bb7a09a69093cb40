"""Likelihoods and probabilities: the signature that is there wins; what cannot be told apart is not."""

import math
from typing import Any

import numpy as np
import pytest

from ftc_jsb.disturbance.sensor_profiles import Errors
from ftc_jsb.isolation.hypotheses import judge, weigh
from ftc_jsb.isolation.records import (
    AIR_X,
    FORCE,
    GYRO_X,
    INERTIAL_X,
    ISOLATION,
    RESIDUALS,
    THRUST_ROW,
)
from ftc_jsb.isolation.redundancy import LOAD_X, PITCH_RATE
from ftc_jsb.isolation.windows import add_block, begin_anew, empty_windows
from ftc_jsb.loops.isolation_settings import isolation_settings, threshold
from ftc_jsb.vocabulary.hypotheses import FIRST_INSTRUMENT, THRUST_LOSS
from ftc_jsb.vocabulary.signals import SENSED

DT = 0.01  # [s]
THRUST = 4.0  # [m/s^2], over mass


@pytest.fixture
def settings() -> Any:
    return np.array([isolation_settings(dict.fromkeys(SENSED, Errors()), True, 0.01, DT)])[0]


@pytest.fixture
def state() -> Any:
    made = np.zeros(1, ISOLATION)[0]
    empty_windows(made["windows"])
    made["signature"][THRUST_ROW, FORCE] = -THRUST
    made["signature"][LOAD_X, [INERTIAL_X, FORCE]] = 9.8
    made["signature"][PITCH_RATE, GYRO_X + 1] = 1.0
    return made


def fill(state: Any, blocks: int, residuals: dict[int, float]) -> None:
    windows = state["windows"]
    for _ in range(blocks):
        windows["total"][:] = 0.0
        for k, value in residuals.items():
            windows["total"][k] = value
        windows["filled"] = 1
        add_block(windows, np.zeros(3), 1.0, THRUST, 0.0)


def test_nothing_wrong_is_no_evidence(settings: Any, state: Any) -> None:
    fill(state, 150, {})
    weigh(settings, state)
    assert state["statistic"] < 1e-6


def test_a_loss_of_thrust_is_told_from_an_accelerometer_by_the_positions(
    settings: Any, state: Any
) -> None:
    """0.4 of the thrust is lost: the force tells it; that the positions agree says whose fault it is."""
    fill(state, 150, {})
    fill(state, 30, {FORCE: -0.4 * THRUST})
    weigh(settings, state)
    assert state["statistic"] > 1.0
    assert judge(state) == THRUST_LOSS
    assert state["probabilities"][THRUST_LOSS] > 0.99
    assert state["amplitude"][THRUST_ROW] == pytest.approx(0.4, rel=0.05)


def test_an_accelerometer_moves_force_and_positions(settings: Any, state: Any) -> None:
    fill(state, 150, {})
    fill(state, 50, {FORCE: -1.5, INERTIAL_X: -1.5})
    weigh(settings, state)
    assert judge(state) == FIRST_INSTRUMENT + LOAD_X


def test_at_first_both_are_possible(settings: Any, state: Any) -> None:
    """In the first 0.2 s positions cannot tell: both explain the force, and only engines fail more often."""
    fill(state, 150, {})
    begin_anew(state["windows"])
    fill(state, 2, {FORCE: -1.5})
    weigh(settings, state)
    likelihood = state["likelihood"]
    assert likelihood[LOAD_X] == pytest.approx(likelihood[THRUST_ROW], rel=0.1)


def test_thrust_that_comes_back_is_no_loss(settings: Any, state: Any) -> None:
    fill(state, 150, {})
    fill(state, 20, {FORCE: +0.4 * THRUST})
    weigh(settings, state)
    assert state["likelihood"][THRUST_ROW] == 0.0


def test_gusts_are_felt_and_widen_what_is_believed(settings: Any, state: Any) -> None:
    """Air that changes by 6 m/s a second is turbulence, not a pitot; the same jump once is evidence."""
    random = np.random.default_rng(1)
    for _ in range(30):
        fill(state, 10, {AIR_X + k: 6.0 * random.standard_normal() for k in range(3)})
    assert state["windows"]["gust"] > 3.0
    still = np.zeros(1, ISOLATION)[0]
    empty_windows(still["windows"])
    fill(still, 300, {})
    assert still["windows"]["gust"] < 0.1


def test_a_fault_that_something_else_is_has_no_name(settings: Any, state: Any) -> None:
    """Every residual far away at once: none of the faults explains it."""
    fill(state, 150, {})
    fill(state, 20, {k: 50.0 * math.sqrt(settings["calm"][3][k]) for k in range(RESIDUALS)})
    weigh(settings, state)
    assert state["unexplained"] > 20.0


def test_the_threshold_follows_the_rate_of_false_alarms() -> None:
    """Ten times fewer alarms cost log(10) of evidence: chance falls off as an exponential."""
    assert threshold(0.001) - threshold(0.01) == pytest.approx(math.log(10.0))
