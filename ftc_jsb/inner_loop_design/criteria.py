"""The steps of docs/aircraft.md: flown at 200 and 300 m/s, 3048 m, against the published criteria."""

import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.errors import TrimError
from ftc_jsb.inner_loop_design.step_flights import (
    BANK_STEP,
    DT,
    MOST_STEP,
    SETTLED,
    SHARE_OF_PULL,
    START,
    TURN_TIME,
    Flown,
    Response,
    bank_step,
    fly_commands,
    load_factor_step,
    response,
    steep_turn,
)
from ftc_jsb.scenario.schema import Initial

AIRSPEEDS = (200.0, 300.0)  # [m/s]
ALTITUDE = 3048.0  # [m]
FUEL = 0.43  # of internal fuel
STEP_TIME = 5.0  # [s]
BANK_TIME = 6.0  # [s]
THRUST_TIMES = (3.0, 9.0, 13.0)  # [s]: idle until, full until, idle again until
RAMP_RATE, RAMP_TIME = 0.8, 4.5  # [1/s], [s]: to a load factor of 4.6
PULL_TIME = 0.3  # [s] that a load factor must be held to count as pulled
NEAR = 0.01  # of the span from idle to full: thrust has arrived


class Steps(NamedTuple):
    """What was flown at one airspeed, and the numbers it is judged by."""

    airspeed: float  # [m/s]
    load_factor: float  # of the step
    load_factor_flight: Flown
    load_factor_response: Response
    bank_flight: Flown
    bank_response: Response
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
    """
    flown = []
    for airspeed in AIRSPEEDS:
        initial = Initial(airspeed=airspeed, altitude=ALTITUDE)
        try:
            flown.append(_steps(aircraft, initial, stock))
        except TrimError:
            continue
    return flown


def _steps(aircraft: Aircraft, initial: Initial, stock: bool) -> Steps:
    def fly(commands: Any, seconds: float) -> Flown:
        return fly_commands(aircraft, initial, FUEL, commands, seconds, stock=stock)

    most = min(MOST_STEP, SHARE_OF_PULL * _pulled(fly(ramp, RAMP_TIME)))
    pulled, rolled = fly(load_factor_step(most), STEP_TIME), fly(bank_step, BANK_TIME)
    turned, pushed = fly(steep_turn, TURN_TIME), fly(thrust_steps, THRUST_TIMES[-1])
    up, down, error = _thrust(pushed)
    return Steps(
        initial.airspeed,
        most,
        pulled,
        _judged(pulled, "load_factor", pulled.load_factor_reference, 1.0, most),
        rolled,
        _judged(rolled, "bank_angle", rolled.bank_reference, 0.0, BANK_STEP),
        float(np.abs(rolled.record["sideslip"]).max()),
        float(np.abs(turned.record["sideslip"][round(SETTLED / DT) :]).max()),
        pushed,
        up,
        down,
        error,
    )


def ramp(time: float, row: Any) -> tuple[float, float, float]:
    """Load factor rising until the aircraft cannot follow, or past what the step needs, wings level."""
    return math.nan, 1.0 + RAMP_RATE * time, 0.0


def _pulled(flown: Flown) -> float:
    """Largest load factor held for PULL_TIME."""
    window = round(PULL_TIME / DT)
    means = np.convolve(flown.record["load_factor"], np.full(window, 1.0 / window), mode="valid")
    return float(means.max())


def _judged(
    flown: Flown, name: str, reference: npt.NDArray[np.float64], first: float, last: float
) -> Response:
    return response(flown.record["time"], flown.record[name], reference, first, last)


def thrust_steps(time: float, row: Any) -> tuple[float, float, float]:
    """Idle, full and idle again: far below the one, far above the other."""
    full = THRUST_TIMES[0] <= time < THRUST_TIMES[1]
    return (1e6 if full else -1e6), math.cos(float(row["flight_path_angle"])), 0.0


def _thrust(flown: Flown) -> tuple[float, float, float]:
    """Times to within NEAR of full and of idle, and the largest error at the end of each level."""
    time, thrust = flown.record["time"], flown.record["thrust"]
    idle, full = flown.levels[:, 0], flown.levels[:, 2]
    share = (thrust - idle) / (full - idle)
    first, second, third = THRUST_TIMES
    rising = (time >= first) & (time < second)
    falling = (time >= second) & (time < third)
    up = time[rising & (share >= 1.0 - NEAR)]
    down = time[falling & (share <= NEAR)]
    ends = [round(end / DT) - 2 for end in THRUST_TIMES]
    error = max(abs(share[ends[0]]), abs(share[ends[1]] - 1.0), abs(share[ends[2]]))
    return (
        float(up[0] - first) if up.size else math.inf,
        float(down[0] - second) if down.size else math.inf,
        float(error),
    )


def kept(steps: Steps) -> bool:
    """Whether every criterion of docs/aircraft.md holds at this airspeed."""
    pulled, rolled = steps.load_factor_response, steps.bank_response
    return (
        pulled.rise <= 0.6
        and pulled.overshoot <= 0.10
        and pulled.error <= 0.01
        and rolled.settling <= 2.0
        and rolled.overshoot <= 0.05
        and math.degrees(steps.turn_sideslip) <= 0.5
        and steps.thrust_error <= NEAR
    )


COLUMNS = (
    "aircraft", "airspeed [m/s]", "load factor to", "rise [s]", "overshoot [%]", "error [%]",
    "bank settled [s]", "overshoot [%]", "sideslip in it [deg]", "in a steady turn [deg]",
    "thrust up [s]", "down [s]", "error [%]", "criteria",
)  # fmt: skip


def table_row(name: str, steps: Steps) -> list[str]:
    """The numbers of one airspeed, as COLUMNS."""
    pulled, rolled = steps.load_factor_response, steps.bank_response
    return [
        name,
        f"{steps.airspeed:.0f}",
        f"{steps.load_factor:.2f}",
        f"{pulled.rise:.2f}",
        f"{100.0 * pulled.overshoot:.1f}",
        f"{100.0 * pulled.error:.1f}",
        f"{rolled.settling:.2f}",
        f"{100.0 * rolled.overshoot:.1f}",
        f"{math.degrees(steps.roll_sideslip):.2f}",
        f"{math.degrees(steps.turn_sideslip):.3f}",
        f"{steps.thrust_up:.2f}",
        f"{steps.thrust_down:.2f}",
        f"{100.0 * steps.thrust_error:.1f}",
        "kept" if kept(steps) else "not kept",
    ]


def step_window(flown: Flown) -> tuple[npt.NDArray[np.float64], npt.NDArray[Any]]:
    """Time from the step on [s] and the rows of a flight, from 0.5 s before the step."""
    use = flown.record["time"] >= START - 0.5
    return flown.record["time"][use] - START, flown.record[use]
