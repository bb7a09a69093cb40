"""The steps of docs/aircraft.md, flown at the step airspeeds of the aircraft and about 3048 m."""

import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.aircraft.test_range import step_airspeeds, usual_altitude
from ftc_jsb.errors import TrimError
from ftc_jsb.inner_loop_design.handling import CLASSES, Handling, class_of, largest_step
from ftc_jsb.inner_loop_design.step_commands import (
    START,
    bank_step,
    load_factor_step,
    ramp,
    steep_turn,
    thrust_steps,
)
from ftc_jsb.inner_loop_design.step_flights import Flown, fly_commands
from ftc_jsb.inner_loop_design.step_response import StepResponse, step_response
from ftc_jsb.scenario.schema import Initial
from ftc_jsb.six_dof.commanded_flight import DT, Commands

FUEL = 0.43  # of internal fuel
BANK_EXTRA = 1.0  # [s] of a bank step beyond that of a load factor
RAMP_TIME = 4.5  # [s]: to a load factor of 4.6
SETTLED = 1.0  # [s] after the bank must have settled: a turn is steady
TURN_EXTRA = 5.0  # [s] of steady turn
PULL_TIME = 0.3  # [s] that a load factor must be held to count as pulled
NEAR = 0.01  # of the span from idle to full: thrust has arrived


class Steps(NamedTuple):
    """What was flown at one airspeed, and the numbers that they are judged by."""

    airspeed: float  # [m/s]
    load_factor: float  # of the step
    load_factor_flight: Flown
    load_factor_response: StepResponse
    bank_flight: Flown
    bank_response: StepResponse
    roll_sideslip: float  # [rad], largest in the bank step
    turn_sideslip: float  # [rad], largest in the steady turn
    thrust_flight: Flown
    thrust_up: float  # [s] from idle to within NEAR of full
    thrust_down: float  # [s] back
    thrust_error: float  # of the span, at the end of each level


def fly_steps(aircraft: Aircraft, stock: bool = False) -> list[Steps]:
    """Every step at each airspeed that trims.

    Args:
        aircraft: as loaded.
        stock: fly the stock flight control.

    Raises:
        AircraftError: it cannot be woven, loaded or flown.
    """
    handling = CLASSES[class_of(aircraft)]
    flown = []
    for airspeed in step_airspeeds(aircraft):
        initial = Initial(airspeed=airspeed, altitude=usual_altitude(aircraft.flight_test))
        try:
            flown.append(_steps(aircraft, handling, initial, stock))
        except TrimError:
            continue
    return flown


def _steps(aircraft: Aircraft, handling: Handling, initial: Initial, stock: bool) -> Steps:
    def fly(commands: Commands, seconds: float) -> Flown:
        return fly_commands(aircraft, initial, FUEL, commands, seconds, stock=stock)

    most = min(largest_step(aircraft), handling.pull_share * _pulled(fly(ramp, RAMP_TIME)))
    seconds, bank = handling.step_time, handling.bank_step
    pulled = fly(load_factor_step(most), seconds)
    rolled = fly(bank_step(bank), seconds + BANK_EXTRA)
    settled = handling.bank_settling + SETTLED
    turned = fly(steep_turn(handling.steep_turn), settled + TURN_EXTRA)
    pushed = fly(thrust_steps(handling.thrust_times), handling.thrust_times[-1])
    up, down, error = _thrust(pushed, handling.thrust_times)
    return Steps(
        initial.airspeed,
        most,
        pulled,
        _step_response(pulled, "load_factor", pulled.load_factor_reference, 1.0, most),
        rolled,
        _step_response(rolled, "bank_angle", rolled.bank_reference, 0.0, bank),
        float(np.abs(rolled.record["sideslip"]).max()),
        float(np.abs(turned.record["sideslip"][round(settled / DT) :]).max()),
        pushed,
        up,
        down,
        error,
    )


def _pulled(flown: Flown) -> float:
    """Largest load factor held for PULL_TIME."""
    window = round(PULL_TIME / DT)
    means = np.convolve(flown.record["load_factor"], np.full(window, 1.0 / window), mode="valid")
    return float(means.max())


def _step_response(
    flown: Flown, name: str, reference: npt.NDArray[np.float64], first: float, last: float
) -> StepResponse:
    return step_response(flown.record["time"], flown.record[name], reference, first, last)


def _thrust(flown: Flown, times: tuple[float, float, float]) -> tuple[float, float, float]:
    """Times to within NEAR of full and of idle, and the largest error at the end of each level."""
    time, thrust = flown.record["time"], flown.record["thrust"]
    idle, full = flown.levels[:, 0], flown.levels[:, 2]
    share = (thrust - idle) / (full - idle)
    first, second, third = times
    rising = (time >= first) & (time < second)
    falling = (time >= second) & (time < third)
    up = time[rising & (share >= 1.0 - NEAR)]
    down = time[falling & (share <= NEAR)]
    ends = [round(end / DT) - 2 for end in times]
    error = max(abs(share[ends[0]]), abs(share[ends[1]] - 1.0), abs(share[ends[2]]))
    return (
        float(up[0] - first) if up.size else math.inf,
        float(down[0] - second) if down.size else math.inf,
        float(error),
    )


def step_window(flown: Flown) -> tuple[npt.NDArray[np.float64], npt.NDArray[Any]]:
    """Time from the step on [s] and the rows of a flight, from 0.5 s before the step."""
    use = flown.record["time"] >= START - 0.5
    return flown.record["time"][use] - START, flown.record[use]
