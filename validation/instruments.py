"""Is the standard deviation of the estimate a confidence? Five fighters, real instruments, turbulence.

`python -m validation.instruments [SEEDS] [FIRST]` prints the table; `make validate` writes it. Nothing was
chosen by these flights, seeds and faults: `robust` was chosen on seeds 100 to 305.
"""

import json
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly

AIRSPEEDS = {"f16": 270, "f15": 240, "F4N": 240, "A4": 200, "T38": 230}  # [m/s]
AIR = ("none", "light", "moderate", "severe")
FIRST, SEEDS = 5000, 8
SETTLED = 2.0  # [s] after the loss
BEGINS = 5.0  # [s]

TITLE = "The standard deviation of the estimate"
WORDS = (
    f"Loop `robust`, tactical sensors that the inner loop reads too, seeds {FIRST} to {FIRST + SEEDS - 1}, "
    "by none of which anything was chosen: a climb, turns, a change of airspeed, and a loss of 0.15 to 0.6 "
    "of the thrust at a random time (`validation/instruments.py`). Judged from 5 s on, but for 2 s after the "
    "loss. Wanted: truth inside ±2σ in 90 to 99 % of the time, normalised squared error (NEES) 1 on the "
    "average, 95 % error ≤ 0.05."
)


class Found(NamedTuple):
    """Of one flight."""

    error: float  # 95 % of the magnitudes
    inside: float  # part of the time inside 2 sigma
    nees: float
    deviation: float  # mean
    false_alarms: int
    delay: float  # [s]; nan = the loss was not declared


def overrides(name: str, air: str, seed: int) -> tuple[list[str], float]:
    """Overrides of `nominal`, and when the loss is [s]."""
    random = np.random.default_rng(seed)
    airspeed = AIRSPEEDS[name]
    left, start = round(random.uniform(0.4, 0.85), 2), round(random.uniform(25.0, 45.0), 1)
    climb, turn = random.uniform(-4.0, 4.0), random.uniform(-60.0, 60.0)
    later = round(airspeed * random.uniform(0.95, 1.05), 1)
    there = 20.1 + abs(turn) / 4.0
    path = [[0, 0], [10, 0], [15, climb], [30, climb], [35, 0]]
    heading = [[0, 0], [20, 0], [there, turn], [55, turn], [35 + there, 0]]
    lost = f'target="thrust",kind="loss-of-effectiveness",effectiveness={left},start={start}'
    return [
        "model=jsbsim",
        f"aircraft.name={name}",
        "duration=90",
        f"initial.airspeed={airspeed}",
        "initial.altitude=4500",
        f"reference.airspeed={json.dumps([[0, airspeed], [40, airspeed], [55, later]])}",
        f"reference.flight_path_deg={json.dumps(path)}",
        f"reference.heading_deg={json.dumps(heading)}",
        "loop.name=robust",
        "sensors.profile=tactical",
        f"wind.turbulence={air}",
        f"seed={seed}",
        f"fault=[{{{lost}}}]",
    ], start


def found(name: str, air: str, seed: int) -> Found:
    """Fly one and judge its estimate."""
    given, start = overrides(name, air, seed)
    row: Any = fly(load_scenario("nominal", given)).record
    time = row["time"]
    use = (time > BEGINS) & ((time < start) | (time > start + SETTLED))
    error = (row["effectiveness_thrust_est"] - row["effectiveness_thrust"])[use]
    deviation = row["effectiveness_thrust_std"][use]
    declared = row["fault_declared"] > 0.5
    before, after = declared & (time < start), declared & (time >= start)
    return Found(
        float(np.percentile(np.abs(error), 95.0)),
        float(np.mean(np.abs(error) < 2.0 * deviation)),
        float(np.mean((error / deviation) ** 2)),
        float(np.mean(deviation)),
        int(np.count_nonzero(np.diff(before.astype(int)) > 0)),
        float(time[after][0] - start) if after.any() else np.nan,
    )


def instruments_table(seeds: int = SEEDS, first: int = FIRST) -> Iterator[str]:
    """A line for each aircraft and air."""
    yield (
        "| aircraft | turbulence | 95 % error | mean σ | inside ±2σ | NEES | false alarms | not declared "
        "| delay, median [s] |"
    )
    yield "|" + "---|" * 9
    with ProcessPoolExecutor(2) as pool:
        for air in AIR:
            for name in AIRSPEEDS:
                flights = list(pool.map(partial(found, name, air), range(first, first + seeds)))
                yield f"| {name} | {air} | {_line(np.array(flights, dtype=float).T)} |"


def _line(columns: npt.NDArray[np.float64]) -> str:
    """Cells of (6, flights) numbers, in the order of `Found`."""
    error, inside, nees, deviation, alarms, delay = columns
    missed, median = int(np.isnan(delay).sum()), "–"
    if missed < delay.size:
        median = f"{np.nanmedian(delay):.2f}"
    return (
        f"{error.mean():.3f} | {deviation.mean():.3f} | {100 * inside.mean():.0f} % | {nees.mean():.2f} "
        f"| {alarms.sum():.0f} | {missed} of {delay.size} | {median}"
    )


if __name__ == "__main__":
    for line in instruments_table(*map(int, sys.argv[1:])):
        print(line, flush=True)
