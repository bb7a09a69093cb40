"""Healthy fighters in still air, flown hard: pushovers, pull-ups, bunts into a turn, reversals.

`python -m validation.envelope FLIGHTS SEED` flies them on the five JSBSim fighters and judges each
recording anew, by rules of its own that share no code with the verdict of the program. It prints every
flight that is not clean, and every flight on which the two do not agree.
"""

import json
import sys
from collections import Counter
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.errors import TrimError
from ftc_jsb.recording.flight import Flight
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly

AIRSPEEDS = {
    "f16": (200, 320),
    "f15": (190, 300),
    "F4N": (190, 280),
    "A4": (180, 270),
    "T38": (190, 280),
}
ALTITUDES = (2500.0, 7500.0)  # [m]
DURATION = 60.0  # [s]
COUNT, SEED = 500, 31
TITLE = "Flown hard, healthy, in still air"
WORDS = (
    f"{COUNT} pushovers, pull-ups, bunts into a turn and reversals of the five fighters (`python -m "
    f"validation.envelope {COUNT} {SEED}`), loop `ftc`. Unclean: on its back, departed, slipping or low, by a "
    "judge of the recording that shares no code with the verdict."
)

Points = list[list[float]]


class Manoeuvre(NamedTuple):
    """What is flown from straight flight at 5 s on; times [s], angles [deg]."""

    kind: str
    start: float  # flight path angle at the start
    path: Points
    heading: Points


def manoeuvres(random: np.random.Generator) -> Iterator[Manoeuvre]:
    """Without end, one kind after the other."""
    level: Points = [[0.0, 0.0]]
    while True:
        start, end, rate = random.uniform(0, 12), random.uniform(-25, 5), random.uniform(1, 8)
        way = [[0.0, start], [5.0, start], [5.1 + abs(end - start) / rate, end]]
        yield Manoeuvre("pushover", start, way, level)
        top, rate = random.uniform(5, 25), random.uniform(2, 8)
        reached = 5.1 + top / rate
        over = [
            [reached + 3.0, top],
            [reached + 3.1 + 2.0 * top / rate, -top * random.uniform(0, 1)],
        ]
        yield Manoeuvre("pull-up", 0.0, [[0.0, 0.0], [5.0, 0.0], [reached, top], *over], level)
        down, rate = random.uniform(-20, -4), random.uniform(2, 8)
        turn = random.choice([-1.0, 1.0]) * random.uniform(10, 120)
        begins, turning = random.uniform(4, 7), random.uniform(3, 15)
        bunt = [[0.0, 0.0], [5.0, 0.0], [5.0 + abs(down) / rate, down]]
        into = [[0.0, 0.0], [begins, 0.0], [begins + abs(turn) / turning, turn]]
        yield Manoeuvre("bunt into a turn", 0.0, bunt, into)
        half = random.choice([-180.0, 180.0])
        back = [[0.0, 0.0], [5.0, 0.0], [5.0 + 180.0 / random.uniform(8, 60), half]]
        yield Manoeuvre("reversal", 0.0, level, back)


def cases(count: int, seed: int) -> Iterator[tuple[str, list[str]]]:
    """Kind and overrides of `nominal` for each flight: the fighters in turn for each kind."""
    random = np.random.default_rng(seed)
    way = manoeuvres(random)
    for number in range(count):
        name = list(AIRSPEEDS)[(number // 4) % len(AIRSPEEDS)]
        manoeuvre = next(way)
        airspeed = round(float(random.uniform(*AIRSPEEDS[name])))
        yield (
            manoeuvre.kind,
            [
                "model=jsbsim",
                f"aircraft.name={name}",
                f"duration={DURATION}",
                f"initial.airspeed={airspeed}",
                f"initial.altitude={random.uniform(*ALTITUDES):.0f}",
                f"initial.flight_path_deg={manoeuvre.start}",
                f"reference.airspeed=[[0,{airspeed}]]",
                f"reference.flight_path_deg={json.dumps(manoeuvre.path)}",
                f"reference.heading_deg={json.dumps(manoeuvre.heading)}",
            ],
        )


def judgement(flight: Flight) -> list[str]:
    """What is wrong with a flight, from its recording alone."""
    row: Any = flight.record
    upside_down = np.cos(row["bank_angle"]) < np.cos(np.radians(95.0))
    found = {
        "did not last": flight.outcome.status != "complete",
        "on its back": np.count_nonzero(upside_down) > 0.3 / flight.row_period,
        "angle of attack": np.ptp(np.degrees(row["alpha"])) > 60.0,
        "sideslip beyond 12 deg": np.abs(row["sideslip"]).max() > np.radians(12.0),
        "low": row["altitude"].min() < 100.0,
        "spinning": np.abs(row["yaw_rate"]).max() > 1.2,  # [rad/s]
    }
    return [name for name, is_so in found.items() if is_so]


def sweep(count: int, seed: int) -> Counter[str]:
    """Fly, judge, print what is not clean."""
    tally: Counter[str] = Counter()
    for number, (kind, overrides) in enumerate(cases(count, seed)):
        try:
            flight = fly(load_scenario("nominal", overrides))
        except TrimError:
            tally["no trim"] += 1
            continue
        wrong, metrics = judgement(flight), flight_metrics(flight)
        tally[kind] += 1
        tally[f"verdict: {metrics['verdict']}"] += 1
        tally["judged unclean"] += bool(wrong)
        flattered = bool(wrong) and metrics["verdict"] == "inside limits"
        tally["unclean and inside limits"] += flattered
        if wrong:
            print(f"{number}: {kind}: {', '.join(wrong)}; verdict {metrics['verdict']}")
            print("   ", " ".join(f"--set '{override}'" for override in overrides), flush=True)
    return tally


def envelope_section() -> Iterator[str]:
    """The tally of COUNT flights."""
    yield "| | flights |"
    yield "|---|---|"
    for name, times in sorted(sweep(COUNT, SEED).items()):
        yield f"| {name} | {times} |"


if __name__ == "__main__":
    found = sweep(int(sys.argv[1]), int(sys.argv[2]))
    print(", ".join(f"{name}: {times}" for name, times in sorted(found.items())))
