"""Sensors and turbulence: the estimate over many seeds, false alarms over hours, what each part buys."""

import json
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from typing import Any, NamedTuple

import numpy as np

from ftc_jsb.analysis.effectiveness_estimate import judged
from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly

SEEDS = 20
PROCESSES = 2
DISTURBED = ("sensors.profile=tactical", "wind.turbulence=moderate")
HOURS = 10  # paper manoeuvres of 60 s in a fault-free flight


class Flown(NamedTuple):
    """What is kept of one flight."""

    errors: Any  # |estimate - truth| where it is judged
    metrics: dict[str, Any]


def _flown(job: tuple[str, tuple[str, ...]]) -> Flown:
    scenario, overrides = job
    flight = fly(load_scenario(scenario, overrides))
    error = np.abs(
        flight.record["effectiveness_thrust_est"] - flight.record["effectiveness_thrust"]
    )
    use = judged(flight)
    return Flown(error[use].astype(np.float32), flight_metrics(flight))


def many(scenario: str, *overrides: str, seeds: int = SEEDS) -> list[Flown]:
    """The same scenario with `model=jsbsim` and seeds 0, 1, ..."""
    jobs = [(scenario, ("model=jsbsim", f"seed={seed}", *overrides)) for seed in range(seeds)]
    with ProcessPoolExecutor(PROCESSES) as pool:
        return list(pool.map(_flown, jobs))


def repeated(times: int) -> list[str]:
    """The paper's manoeuvre over and over, without a fault."""
    reference = load_scenario("paper").reference
    overrides = [f"duration={60 * times}", "fault=[]"]
    for name in ("flight_path_deg", "heading_deg"):
        points = [
            [60.0 * k + time, value]
            for k in range(times)
            for time, value in getattr(reference, name)
        ]
        overrides.append(f"reference.{name}={json.dumps(points)}")
    return overrides


def row(title: str, flights: Sequence[Flown]) -> str:
    """A line of the table."""
    errors = np.concatenate([flight.errors for flight in flights])
    late = [f.metrics["detection_delay_s"] for f in flights]
    delays = [value for value in late if value is not None]
    worst = f"{max(delays):.2f}" if delays else "–"
    missed = sum(value is None for value in late)
    alarms = sum(f.metrics["false_alarms"] or 0 for f in flights)
    rmse = np.median([f.metrics["rmse_airspeed_mps"] for f in flights])
    complete = sum(f.metrics["status"] == "complete" for f in flights)
    return (
        f"| {title} | {np.percentile(errors, 95):.4f} | {errors.max():.3f} | {worst} | {missed} "
        f"| {alarms} | {rmse:.2f} | {complete} of {len(flights)} |"
    )


def robust_table(scenario: str = "paper") -> Iterator[str]:
    """The loops under real sensors and moderate turbulence, and under parts of them."""
    yield (
        "| flight | effectiveness error, 95 % of all samples | largest | slowest detection [s] "
        "| not detected | false alarms | median RMSE V [m/s] | complete |"
    )
    yield "|" + "---|" * 8
    no_accelerometer = (
        "loop.name=ftc", "loop.estimator.tuning=sensors", "loop.feedback=estimated",
    )  # fmt: skip
    cases = {
        "`ftc`, calm, perfect sensors": ("loop.name=ftc",),
        "`robust`, calm, perfect sensors": ("loop.name=robust",),
        "`robust`, calm, tactical sensors": ("loop.name=robust", DISTURBED[0]),
        "`robust`, moderate, perfect sensors": ("loop.name=robust", DISTURBED[1]),
        "**`robust`, moderate, tactical sensors**": ("loop.name=robust", *DISTURBED),
        "`ftc` with the printed Q, R, the same": ("loop.name=ftc", *DISTURBED),
        "`ftc` tuned by sensors and gusts, no accelerometer": (*no_accelerometer, *DISTURBED),
        "the same, response in 3 s": (
            *no_accelerometer, "loop.estimator.response_time=3.0", *DISTURBED,
        ),
        "`robust`, severe, tactical sensors": (
            "loop.name=robust", DISTURBED[0], "wind.turbulence=severe",
        ),
    }  # fmt: skip
    for title, overrides in cases.items():
        seeds = SEEDS if any(key in overrides for key in DISTURBED) else 1
        yield row(title, many(scenario, *overrides, seeds=seeds))


def fighters_robust_table(seeds: int = SEEDS) -> Iterator[str]:
    """The loop `robust` on each fighter's scenario, tactical sensors and moderate turbulence."""
    from validation.fighters import SCENARIOS

    yield (
        "| fighter | effectiveness error, 95 % of all samples | largest | slowest detection [s] "
        "| not detected | false alarms | median RMSE V [m/s] | complete |"
    )
    yield "|" + "---|" * 8
    for name, scenario in SCENARIOS.items():
        yield row(name, many(scenario, "loop.name=robust", *DISTURBED, seeds=seeds))


def false_alarms_table(scenario: str = "paper") -> Iterator[str]:
    """Fault-free flights of ten minutes."""
    yield "| loop | flights | hours | false alarms | largest effectiveness error |"
    yield "|---|---|---|---|---|"
    flights = many(
        scenario, "loop.name=robust", "aircraft.fuel_fraction=0.8", *DISTURBED, *repeated(HOURS)
    )
    alarms = sum(flight.metrics["false_alarms"] for flight in flights)
    hours = sum(flight.metrics["end_time_s"] for flight in flights) / 3600.0
    largest = max(flight.errors.max() for flight in flights)
    yield f"| robust | {len(flights)} | {hours:.2f} | {alarms} | {largest:.3f} |"
