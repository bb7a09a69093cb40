"""Navigation by accelerometers and attitude, held to positions: what it says of them and of gyros."""

import math
from typing import Any

import numpy as np
import pytest

from ftc_jsb.isolation.navigation import (
    inertial_acceleration,
    navigate,
    start_navigation,
    to_body,
    to_level,
    turn_by_gyros,
)
from ftc_jsb.isolation.records import NAVIGATION

DT = 0.01  # [s]
GRAVITY = 9.81  # [m/s^2]
LAG = np.zeros(3)


def navigation(attitude: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Any:
    made = np.zeros(1, NAVIGATION)[0]
    start_navigation(made, (0.0, 0.0, -3000.0), (250.0, 0.0, 0.0), attitude)
    return made


def test_there_and_back_is_the_same_vector() -> None:
    attitude, vector = (0.4, -0.2, 2.0), (1.0, -2.0, 3.0)
    assert to_body(*attitude, to_level(*attitude, vector)) == pytest.approx(vector)


def test_level_flight_accelerates_nowhere() -> None:
    """One g up in level flight cancels gravity; banked, the same load factor pulls to the side."""
    level = inertial_acceleration((0.0, 0.0, 1.0), 0.0, 0.0, 0.0, 9.80665)
    assert level == pytest.approx((0.0, 0.0, 0.0))
    banked = inertial_acceleration((0.0, 0.0, 1.0), math.radians(30.0), 0.0, 0.0, 9.80665)
    assert banked[1] == pytest.approx(9.80665 * math.sin(math.radians(30.0)))
    assert banked[2] > 0.0  # it sinks


@pytest.mark.parametrize("yaw_rate", [0.0, 0.1])
def test_what_is_wrong_with_an_accelerometer_is_found_in_body_axes(yaw_rate: float) -> None:
    """An error of 0.5 m/s^2 ahead is found to 2 % in 5 s, in straight flight and in a turn of 6 deg/s."""
    made, wrong = navigation(), 0.5
    truth = np.array([0.0, 0.0, -3000.0])
    speed, yaw = np.array([250.0, 0.0, 0.0]), 0.0
    for i in range(1, 800):
        turning = np.array([-math.sin(yaw), math.cos(yaw), 0.0]) * 250.0 * yaw_rate
        truth, speed = truth + DT * speed + 0.5 * DT**2 * turning, speed + DT * turning
        yaw += yaw_rate * DT
        ahead = np.array(to_level(0.0, 0.0, yaw, (wrong, 0.0, 0.0)))
        seen = tuple(truth + 1e-6 * i)  # a reading that lives
        navigate(made, tuple(turning + ahead), (0.0, 0.0, yaw), seen, LAG, DT)
    assert made["acceleration"] == pytest.approx([-wrong, 0.0, 0.0], abs=0.02 * wrong + 0.01)


def test_a_gyro_that_is_off_shows_on_its_own_axis() -> None:
    """Banked by 40 deg and turning: yaw rate off by 1 deg/s shows there and nowhere else."""
    attitude = (math.radians(40.0), 0.05, 0.0)
    made, off = navigation(attitude), math.radians(1.0)
    roll, pitch, yaw = attitude
    turn = 0.05  # [rad/s]
    body = (
        -turn * math.sin(pitch),
        turn * math.cos(pitch) * math.sin(roll),
        turn * math.cos(pitch) * math.cos(roll),
    )
    said = (0.0, 0.0, 0.0)
    for _ in range(500):
        yaw += turn * DT
        said = turn_by_gyros(made, (body[0], body[1], body[2] + off), (roll, pitch, yaw), 0.0, DT)
    assert said == pytest.approx((0.0, 0.0, off), abs=2e-4)
