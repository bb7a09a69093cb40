"""False alarms an hour of flights without a fault, and how often chance reaches a log likelihood ratio."""

import math
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.errors import UserError
from ftc_jsb.loops.isolation_settings import AT, THRESHOLD, threshold
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from ftc_jsb.vocabulary.hypotheses import HYPOTHESES
from validation.envelope import AIRSPEEDS
from validation.isolation.flights import FIRST, Mission, overrides

HOURS = 5.0
DURATION = 300.0  # [s] of a flight
PEAK = 10.0  # [s] that a largest ratio is taken of
PROVEN = 3.0  # -ln 0.05: events that a rate must have been expected to make, for 95 % confidence
TOLD_EVERY = 120  # flights: ten hours


class Healthy(NamedTuple):
    """Of one flight without a fault."""

    hours: float
    alarms: int  # of the detector and of the isolation
    peaks: npt.NDArray[np.float64]  # largest log likelihood ratio of every PEAK
    text: str  # of the alarms


def healthy(mission: Mission) -> Healthy:
    """Fly one."""
    try:
        flight = fly(load_scenario("nominal", overrides(mission)))
    except UserError:
        return Healthy(0.0, 0, np.empty(0), "")
    metrics = flight_metrics(flight)
    said = [
        f"{each['time_s']:.1f} s {each['suspect']} {each['probability']:.2f}"
        for each in metrics["suspicions"]
        if each["suspect"] != HYPOTHESES[0]
    ]
    said += [f"detector, {metrics['false_alarms']} times"] if metrics["false_alarms"] else []
    flown = threshold(flight.scenario.loop.isolation.false_alarms)
    level = flown * np.nan_to_num(flight.record["isolation_statistic"])
    length = round(PEAK / flight.row_period)
    rows = level[: level.size // length * length].reshape(-1, length)
    text = f"{mission.aircraft} {mission.air} {mission.seed}: {'; '.join(said)}" if said else ""
    return Healthy(flight.outcome.time / 3600.0, len(said), rows.max(axis=1), text)


def rates(hours: float = HOURS, first: int = FIRST + 5000) -> Iterator[str]:
    """Alarms as they come, then the count and the average run length of each threshold."""
    seeds = math.ceil(hours * 3600.0 / DURATION / (len(AIRSPEEDS) * 2))
    missions = [
        Mission(name, air, first + seed, duration=DURATION)
        for seed in range(seeds)
        for name in AIRSPEEDS
        for air in ("light", "moderate")
    ]
    flown, alarms, peaks = 0.0, 0, []
    with ProcessPoolExecutor(2) as pool:
        for number, each in enumerate(pool.map(healthy, missions), 1):
            flown, alarms = flown + each.hours, alarms + each.alarms
            peaks.append(each.peaks)
            if each.text:
                yield each.text
            if number % TOLD_EVERY == 0:
                print(f"{flown:.1f} h, {alarms} alarms", file=sys.stderr, flush=True)
    yield f"{flown:.1f} h without a fault, {alarms} alarms"
    if alarms == 0:
        yield f"(fewer than {PROVEN / flown:.3f} an hour with 95 % confidence)"
    level = np.concatenate(peaks)
    yield "| log likelihood ratio | exceeded in an hour | average run length [h] |"
    yield "|---|---|---|"
    for ratio in range(4, 24, 2):
        count = float(np.sum(level > ratio)) / flown
        length = f"{1.0 / count:.3g}" if count else f"> {flown:.3g}"
        yield f"| {ratio} | {count:.3g} | {length} |"
    yield f"A threshold of {THRESHOLD} is meant for {AT} an hour, one more for a part of e of it."
