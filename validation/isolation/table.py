"""Every class of faults on every fighter, in four airs, with perfect and tactical sensors: who was named."""

import math
from collections import Counter, defaultdict
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from typing import Any, NamedTuple

import numpy as np

from ftc_jsb.analysis.isolation import SAFE, name_of
from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.errors import UserError
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from ftc_jsb.vocabulary.hypotheses import HYPOTHESES
from validation.envelope import AIRSPEEDS
from validation.isolation.flights import AIR, CLASSES, FIRST, HEALTHY, Mission, overrides

SEEDS = 1
SENSORS = ("perfect", "tactical")
SETTLED = 5.0  # [s] from which on the estimate is judged
AFTER = 2.0  # [s] after the fault in which it is not
TAKEN_BACK = 3.0  # [s] in which a decision may be corrected
BAND = 2.0  # standard deviations

TITLE = "Whose fault is it?"
WORDS = (
    f"Loop `robust`, {SEEDS} flight of 60 s for each class, fighter, air and suite of sensors (`python -m "
    f"validation.isolation table`), seeds from {FIRST}, by which nothing was chosen. Right: the fault's own "
    f"hypothesis with a probability of {SAFE} or more, or the last such decision in {TAKEN_BACK:.0f} s; for a "
    "healthy aircraft: nobody. The error of the estimate is that of 95 % of a flight from "
    f"{SETTLED:.0f} s on, but for {AFTER:.0f} s after the fault; so is the part of it in which the truth is "
    "within two standard deviations. NEES is its square over the variance, 1 where σ is right."
)


class Judged(NamedTuple):
    """Of one flight."""

    fault: str
    mission: Mission
    named: str  # the first decision after the fault; "" = none
    right: bool
    delay: float  # [s] of that decision; nan = none
    early: int  # decisions before the fault, detector's alarms among them
    later_wrong: int  # decisions after the first right one that name somebody else
    error: float  # 95 % of the estimate's
    inside: float  # part of the time that the truth is within BAND sigma
    nees: float
    lost: bool  # control


def judged(job: tuple[str, Mission]) -> Judged | None:
    """Fly one; None where it has no trim."""
    fault, mission = job
    try:
        flight = fly(load_scenario("nominal", overrides(mission, fault)))
    except UserError:
        return None
    metrics = flight_metrics(flight)
    healthy = fault == HEALTHY
    start = math.inf if healthy else flight.scenario.fault[0].start
    at_fault = "" if healthy else name_of(flight.scenario.fault[0].target)
    decided = [
        each
        for each in metrics["suspicions"]
        if each["suspect"] != HYPOTHESES[0] and each["probability"] >= SAFE
    ]
    after = [each for each in decided if each["time_s"] >= start]
    # What was taken for lost thrust and taken back when the accelerometer was found out counts by the end
    final = (
        [each for each in after if each["time_s"] <= after[0]["time_s"] + TAKEN_BACK]
        if after
        else []
    )
    named = final[-1]["suspect"] if final else ""
    row: Any = flight.record
    time = row["time"]
    use = (time > SETTLED) & ((time < start) | (time > start + AFTER))
    error = np.abs(row["effectiveness_thrust_est"] - row["effectiveness_thrust"])[use]
    normal = error / np.maximum(row["effectiveness_thrust_std"][use], 1e-9)
    return Judged(
        fault,
        mission,
        named,
        named == at_fault,
        after[0]["time_s"] - start if after else math.nan,
        len(decided) - len(after) + (metrics["false_alarms"] if healthy else 0),
        sum(each["suspect"] != at_fault for each in after[len(final) :]),
        float(np.percentile(error, 95.0)),
        float(np.mean(normal <= BAND)),
        float(np.mean(normal**2)),
        metrics["verdict"] in ("loss of control", "departed"),
    )


def fly_all(seeds: int, first: int) -> Iterator[list[Judged]]:
    """Flights of a class, class by class; the healthy ones first."""
    with ProcessPoolExecutor(2) as pool:
        for number, fault in enumerate([HEALTHY, *CLASSES]):
            jobs = [
                (fault, Mission(name, air, first + 100 * number + seed, sensors))
                for seed in range(seeds)
                for sensors in SENSORS
                for name in AIRSPEEDS
                for air in AIR
            ]
            yield [each for each in pool.map(judged, jobs) if each is not None]


def table(seeds: int = SEEDS, first: int = FIRST) -> Iterator[str]:
    """A line for each class as it comes, then for all, each fighter, air and suite."""
    yield (
        "| fault | flights | missed | named right | taken for | delay, median, 95 % [s] | before the fault "
        "| others later | 95 % error of k̂, median, worst | inside ±2σ | NEES | control lost |"
    )
    yield "|" + "---|" * 12
    everything: list[Judged] = []
    for found in fly_all(seeds, first):
        everything += found
        yield _line(found[0].fault, found)
    faulty = [each for each in everything if each.fault != HEALTHY]
    yield _line("all faults", faulty)
    yield _line(
        "… tactical sensors", [each for each in faulty if each.mission.sensors == SENSORS[1]]
    )
    for group in ("sensors", "air", "aircraft"):
        parts = defaultdict(list)
        for each in everything:
            parts[getattr(each.mission, group)].append(each)
        for name, found in parts.items():
            yield _line(f"{group}: {name}", found)


def _line(title: str, found: list[Judged]) -> str:
    faulty = [each for each in found if each.fault != HEALTHY]
    known = [each for each in faulty if each.named]
    wrong = Counter(each.named for each in known if not each.right)
    delays = [each.delay for each in faulty if not math.isnan(each.delay)] or [math.nan]
    errors = [each.error for each in found]
    right = 100.0 * float(np.mean([each.right for each in known])) if known else math.nan
    cells = (
        title,
        len(found),
        sum(not each.named for each in faulty) if faulty else "–",
        f"{right:.0f} %" if known else "–",
        ", ".join(f"{name} {times}" for name, times in wrong.most_common(3)) or "–",
        f"{np.median(delays):.2f}, {np.percentile(delays, 95.0):.2f}" if known else "–",
        sum(each.early for each in found),
        sum(each.later_wrong for each in found),
        f"{np.median(errors):.3f}, {max(errors):.3f}",
        f"{100.0 * np.mean([each.inside for each in found]):.0f} %",
        f"{np.median([each.nees for each in found]):.2f}",
        sum(each.lost for each in found),
    )
    return "| " + " | ".join(str(cell) for cell in cells) + " |"
