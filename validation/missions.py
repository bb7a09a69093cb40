"""Random missions with a loss of thrust, real instruments, calm to moderate turbulence: does FTC help?

`python -m validation.missions FLIGHTS SEED [LOOP]` flies each with LOOP (default `robust`) and without FTC on
the five JSBSim fighters, and judges each recording anew by `envelope.judgement`, which shares no code with the
verdict of the program. It prints every mission in which the two judges do not agree, and every one in which
FTC tracks airspeed worse by 5 %.
"""

import json
import sys
from collections import Counter
from collections.abc import Iterator
from typing import Any

import numpy as np

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.errors import TrimError
from ftc_jsb.recording.flight import Flight
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from validation.envelope import AIRSPEEDS, ALTITUDES, judgement

DURATION = 90.0  # [s]
TURBULENCE = ("none", "light", "moderate")
WORSE = 1.05  # times the RMSE without FTC
NOTICEABLE = 0.3  # [m/s]: differences below it are those of the noise
WITHOUT = "no-ftc"
COUNT, SEED = 200, 2026
TITLE = "Missions with a loss of thrust"
WORDS = (
    f"{COUNT} random missions of the five fighters (`python -m validation.missions {COUNT} {SEED}`): "
    "tactical sensors, calm to moderate turbulence, a loss of 0.1 to 0.7 of the thrust at a random time, "
    "each with `robust` and with `no-ftc`. Better and worse: by 5 % of the airspeed's RMSE (worse: and "
    "0.3 m/s). Unclean: by a judge of the recording that shares no code with the verdict."
)


def missions(count: int, seed: int) -> Iterator[list[str]]:
    """Overrides of `nominal` for each mission: the fighters in turn."""
    random = np.random.default_rng(seed)
    for number in range(count):
        name = list(AIRSPEEDS)[number % len(AIRSPEEDS)]
        slowest, fastest = AIRSPEEDS[name]
        airspeed = round(float(random.uniform(slowest, 0.9 * fastest)))
        faster = round(float(airspeed * random.uniform(0.95, 1.1)))
        begins, climb = random.uniform(5, 40), random.uniform(-6, 6)
        path = [[0, 0], [begins, 0], [begins + 6, climb], [begins + 18, climb], [begins + 24, 0]]
        turning, turn = random.uniform(5, 50), random.uniform(-90, 90)
        heading = [[0, 0], [turning, 0], [turning + abs(turn) / random.uniform(2, 6) + 0.1, turn]]
        lost = {
            "target": "thrust",
            "kind": "loss-of-effectiveness",
            "effectiveness": round(random.uniform(0.3, 0.9), 2),
            "start": round(random.uniform(10, 60), 1),
        }
        yield [
            "model=jsbsim",
            f"aircraft.name={name}",
            f"duration={DURATION}",
            f"seed={random.integers(1, 10**6)}",
            f"initial.airspeed={airspeed}",
            f"initial.altitude={random.uniform(*ALTITUDES):.0f}",
            f"reference.airspeed={json.dumps([[0, airspeed], [30, airspeed], [40, faster]])}",
            f"reference.flight_path_deg={json.dumps(path)}",
            f"reference.heading_deg={json.dumps(heading)}",
            "fault=[{" + ", ".join(f"{key} = {json.dumps(lost[key])}" for key in lost) + "}]",
            "sensors.profile=tactical",
            f"wind.turbulence={random.choice(TURBULENCE)}",
        ]


def airspeed_error(flight: Flight) -> float:
    """RMS [m/s] over the whole flight, whatever became of it."""
    row: Any = flight.record
    return float(np.sqrt(np.mean((row["airspeed"] - row["airspeed_ref"]) ** 2)))


def sweep(count: int, seed: int, loop: str) -> Counter[str]:
    """Fly, judge, print what is remarkable."""
    tally: Counter[str] = Counter()
    for number, overrides in enumerate(missions(count, seed)):
        try:
            flights = {
                name: fly(load_scenario("nominal", [*overrides, f"loop.name={name}"]))
                for name in (loop, WITHOUT)
            }
        except TrimError:
            tally["no trim"] += 1
            continue
        errors = {name: airspeed_error(flight) for name, flight in flights.items()}
        remarks = []
        for name, flight in flights.items():
            wrong, metrics = judgement(flight), flight_metrics(flight)
            tally[f"{name}: {metrics['verdict']}"] += 1
            tally[f"{name}: judged unclean"] += bool(wrong)
            if wrong or metrics["verdict"] == "loss of control":
                remarks.append(
                    f"{name} {metrics['verdict']}: {', '.join(wrong) or metrics['loss_of_control']}"
                )
            tally[f"{name}: unclean and inside limits"] += (
                bool(wrong) and metrics["verdict"] == "inside limits"
            )
        if errors[loop] > WORSE * errors[WITHOUT] + NOTICEABLE:
            tally["FTC worse by 5 %"] += 1
            remarks.append(f"airspeed {errors[loop]:.2f} against {errors[WITHOUT]:.2f} m/s")
        tally["FTC better by 5 %"] += errors[loop] * WORSE < errors[WITHOUT]
        tally["missions"] += 1
        if remarks:
            print(f"{number}: {'; '.join(remarks)}")
            print("   ", " ".join(f"--set '{override}'" for override in overrides), flush=True)
    return tally


def missions_section() -> Iterator[str]:
    """The tally of COUNT missions."""
    yield "| | missions |"
    yield "|---|---|"
    for name, times in sorted(sweep(COUNT, SEED, "robust").items()):
        yield f"| {name} | {times} |"


if __name__ == "__main__":
    found = sweep(
        int(sys.argv[1]), int(sys.argv[2]), sys.argv[3] if len(sys.argv) > 3 else "robust"
    )
    print(", ".join(f"{name}: {times}" for name, times in sorted(found.items())))
