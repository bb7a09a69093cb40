"""Whose fault is it? Flights of five fighters with tactical sensors, each with one fault or with none.

`python -m validation.isolation table [SEEDS] [FIRST]` flies every class of faults on every fighter in calm,
light and moderate air; `rates HOURS [FIRST]` flies without a fault and counts alarms; `roc [SEEDS] [FIRST]`
weighs losses of thrust that are found against alarms by chance; `learn` prints `ftc_jsb/isolation/scatter.py`
anew, from seeds 100 to 103. Seeds of the others begin at 17000: nothing was chosen by them.
"""

import json
import math
import sys
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.isolation import SAFE, name_of
from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.errors import UserError
from ftc_jsb.isolation.records import FORCE, RESIDUALS, SPANS
from ftc_jsb.isolation.windows import look_back
from ftc_jsb.loops.isolation_settings import AT, THRESHOLD
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.advance import advance
from ftc_jsb.simulation.assembly import assemble
from ftc_jsb.simulation.fly import fly
from ftc_jsb.vocabulary.hypotheses import HYPOTHESES
from validation.envelope import AIRSPEEDS, ALTITUDES

AIR = ("none", "light", "moderate")
LEARNED = range(100, 104)  # seeds
FIRST, SEEDS = 17000, 1
HOURS = 5.0
MARGIN = 1.2  # on variances: other flights than those of learning are flown
Random = np.random.Generator
Draw = Callable[[Random], dict[str, Any]]

TITLE = "Whose fault is it?"
WORDS = (
    f"Loop `robust`, tactical sensors, {SEEDS} flight of 60 s for each class, fighter and air (`python -m "
    f"validation.isolation table`), seeds from {FIRST}, by which nothing was chosen. Named: the right "
    "hypothesis "
    "with a probability of 0.9 or more, or the last such decision in 3 s. The estimate's error is 95 % of the "
    "flight from 5 s on, but for 2 s after the fault."
)


def _size(random: Random, low: float, high: float, digits: int = 2) -> float:
    return round(float(random.choice([-1.0, 1.0]) * random.uniform(low, high)), digits)


def _sensor(target: str, kind: str, low: float = 0.0, high: float = 0.0) -> Draw:
    """A fault of a sensor; sizes in its unit, degrees for angles."""

    def draw(random: Random) -> dict[str, Any]:
        angle = target in ("alpha", "sideslip", "roll", "pitch", "yaw") or target.endswith("_rate")
        key = "size_deg" if angle else "size"
        size = abs(_size(random, low, high)) if kind == "noise" else _size(random, low, high)
        return {"target": target, "kind": kind} | ({key: size} if high > 0.0 else {})

    return draw


def _loss(target: str) -> Draw:
    return lambda random: {
        "target": target,
        "kind": "loss-of-effectiveness",
        "effectiveness": round(float(random.uniform(0.3, 0.8)), 2),
    }


CLASSES: dict[str, Draw] = {
    "thrust": _loss("thrust"),
    "pitot bias 8 to 20 m/s": _sensor("airspeed", "bias", 8.0, 20.0),
    "pitot drift 0.5 to 2 m/s²": _sensor("airspeed", "drift", 0.5, 2.0),
    "pitot frozen": _sensor("airspeed", "freeze"),
    "pitot silent": _sensor("airspeed", "dropout"),
    "alpha bias 1 to 4°": _sensor("alpha", "bias", 1.0, 4.0),
    "alpha drift 0.1 to 0.5 °/s": _sensor("alpha", "drift", 0.1, 0.5),
    "alpha frozen": _sensor("alpha", "freeze"),
    "alpha noise 1 to 2°": _sensor("alpha", "noise", 1.0, 2.0),
    "sideslip bias 1.5 to 4°": _sensor("sideslip", "bias", 1.5, 4.0),
    "sideslip frozen": _sensor("sideslip", "freeze"),
    "load factor x bias 0.05 to 0.2": _sensor("load_factor_x", "bias", 0.05, 0.2),
    "load factor y bias 0.1 to 0.3": _sensor("load_factor_y", "bias", 0.1, 0.3),
    "load factor z bias 0.1 to 0.5": _sensor("load_factor_z", "bias", 0.1, 0.5),
    "roll rate bias 1 to 5 °/s": _sensor("roll_rate", "bias", 1.0, 5.0),
    "pitch rate bias 1 to 5 °/s": _sensor("pitch_rate", "bias", 1.0, 5.0),
    "yaw rate bias 1 to 5 °/s": _sensor("yaw_rate", "bias", 1.0, 5.0),
    "roll bias 2 to 8°": _sensor("roll", "bias", 2.0, 8.0),
    "pitch bias 1 to 4°": _sensor("pitch", "bias", 1.0, 4.0),
    "pitch frozen": _sensor("pitch", "freeze"),
    "yaw bias 2 to 8°": _sensor("yaw", "bias", 2.0, 8.0),
}


def overrides(name: str, air: str, seed: int, duration: float, fault: str | None) -> list[str]:
    """Overrides of `nominal`: a mission of a fighter, and a fault of a class at 15 to 35 s."""
    random = np.random.default_rng([seed, list(AIRSPEEDS).index(name), AIR.index(air)])
    slowest, fastest = AIRSPEEDS[name]
    speed = round(float(random.uniform(slowest, 0.9 * fastest)))
    later = round(float(speed * random.uniform(0.95, 1.1)))
    begins, climb = random.uniform(5.0, 20.0), random.uniform(-6.0, 6.0)
    path = [[0, 0], [begins, 0], [begins + 6, climb], [begins + 18, climb], [begins + 24, 0]]
    path += [[begins + 50, 0], [begins + 56, -climb], [begins + 70, -climb], [begins + 76, 0]]
    turning, turn = random.uniform(5.0, 30.0), random.uniform(-90.0, 90.0)
    there = turning + abs(turn) / random.uniform(2.0, 6.0) + 0.1
    back = turning + 45.0 + abs(turn) / 3.0 + 0.1
    heading = [[0, 0], [turning, 0], [there, turn], [turning + 45.0, turn], [back, 0]]
    faults = []
    if fault is not None:
        faults = [CLASSES[fault](random) | {"start": round(float(random.uniform(15.0, 35.0)), 1)}]
    listed = [
        "{" + ", ".join(f"{key} = {json.dumps(value)}" for key, value in each.items()) + "}"
        for each in faults
    ]
    return [
        "model=jsbsim",
        "loop.name=robust",
        "sensors.profile=tactical",
        f"aircraft.name={name}",
        f"duration={duration}",
        f"seed={seed}",
        f"initial.airspeed={speed}",
        f"initial.altitude={random.uniform(*ALTITUDES):.0f}",
        f"reference.airspeed={json.dumps([[0, speed], [30, speed], [40, later], [70, later], [80, speed]])}",
        f"reference.flight_path_deg={json.dumps(path)}",
        f"reference.heading_deg={json.dumps(heading)}",
        f"wind.turbulence={air}",
        f"fault=[{', '.join(listed)}]",
    ]


class Judged(NamedTuple):
    """Of one flight with a fault."""

    fault: str
    name: str
    air: str
    seed: int
    named: str  # the first decision after the fault; "" = none
    right: bool
    delay: float  # [s] of that decision; nan = none
    early: int  # decisions before the fault
    later_wrong: int  # decisions after the first right one that name somebody else
    error: float  # 95 % of the estimate's
    lost: bool  # control


def judged(fault: str, name: str, air: str, seed: int) -> Judged | None:
    """Fly one; None where it has no trim."""
    try:
        flight = fly(load_scenario("nominal", overrides(name, air, seed, 60.0, fault)))
    except UserError:
        return None
    metrics = flight_metrics(flight)
    start, at_fault = flight.scenario.fault[0].start, name_of(flight.scenario.fault[0].target)
    decided = [
        each
        for each in metrics["suspicions"]
        if each["suspect"] != HYPOTHESES[0] and each["probability"] >= SAFE
    ]
    after = [each for each in decided if each["time_s"] >= start]
    # What was taken for lost thrust and taken back when the accelerometer was found out counts by the end
    final = [each for each in after if each["time_s"] <= after[0]["time_s"] + 3.0] if after else []
    right = bool(final) and final[-1]["suspect"] == at_fault
    row: Any = flight.record
    time = row["time"]
    use = (time > 5.0) & ((time < start) | (time > start + 2.0))
    error = np.abs(row["effectiveness_thrust_est"] - row["effectiveness_thrust"])[use]
    return Judged(
        fault,
        name,
        air,
        seed,
        final[-1]["suspect"] if final else "",
        right,
        after[0]["time_s"] - start if after else math.nan,
        len(decided) - len(after),
        sum(each["suspect"] != at_fault for each in after[len(final) :]),
        float(np.percentile(error, 95.0)),
        metrics["verdict"] in ("loss of control", "departed"),
    )


def table(seeds: int = SEEDS, first: int = FIRST) -> Iterator[str]:
    """A line for each class, and one for all; printed as they come: who was taken for whom."""
    yield (
        "| fault | flights | missed | named right | taken for | delay, median, 95 % [s] | before the fault "
        "| others later | 95 % error of k̂, median, worst | control lost |"
    )
    yield "|" + "---|" * 10
    everything: list[Judged] = []
    with ProcessPoolExecutor(2) as pool:
        for number, fault in enumerate(CLASSES):
            jobs = [
                (fault, name, air, first + 100 * number + seed)
                for seed in range(seeds)
                for name in AIRSPEEDS
                for air in AIR
            ]
            found = [each for each in pool.map(_judged, jobs) if each is not None]
            everything += found
            yield _line(fault, found)
    yield _line("all", everything)
    for key, which in (("aircraft", "name"), ("turbulence", "air")):
        parts = defaultdict(list)
        for each in everything:
            parts[getattr(each, which)].append(each)
        for name, found in parts.items():
            yield _line(f"{key}: {name}", found)


def _judged(job: tuple[str, str, str, int]) -> Judged | None:
    return judged(*job)


def _line(title: str, found: list[Judged]) -> str:
    wrong = Counter(each.named for each in found if each.named and not each.right)
    delays = [each.delay for each in found if not math.isnan(each.delay)] or [math.nan]
    errors = [each.error for each in found]
    known = [each for each in found if each.named]
    cells = (
        title,
        len(found),
        sum(not each.named for each in found),
        f"{100.0 * np.mean([each.right for each in known]):.0f} %" if known else "–",
        ", ".join(f"{name} {times}" for name, times in wrong.most_common(3)) or "–",
        f"{np.median(delays):.2f}, {np.percentile(delays, 95.0):.2f}",
        sum(each.early for each in found),
        sum(each.later_wrong for each in found),
        f"{np.median(errors):.3f}, {max(errors):.3f}",
        sum(each.lost for each in found),
    )
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


class Healthy(NamedTuple):
    """Of one flight without a fault."""

    hours: float
    alarms: int  # of the detector and of the isolation
    peaks: npt.NDArray[np.float64]  # largest log likelihood ratio of every 10 s
    text: str  # of the alarms


def healthy(job: tuple[str, str, int]) -> Healthy:
    """Fly one of 300 s."""
    name, air, seed = job
    try:
        flight = fly(load_scenario("nominal", overrides(name, air, seed, 300.0, None)))
    except UserError:
        return Healthy(0.0, 0, np.empty(0), "")
    metrics = flight_metrics(flight)
    said = [
        f"{each['time_s']:.1f} s {each['suspect']} {each['probability']:.2f}"
        for each in metrics["suspicions"]
        if each["suspect"] != HYPOTHESES[0]
    ]
    alarms = len(said) + metrics["false_alarms"]
    level = THRESHOLD * np.nan_to_num(flight.record["isolation_statistic"])
    length = round(10.0 / flight.row_period)
    rows = level[: level.size // length * length].reshape(-1, length)
    text = f"{name} {air} {seed}: {'; '.join(said)}" if alarms else ""
    return Healthy(flight.outcome.time / 3600.0, alarms, rows.max(axis=1), text)


def rates(hours: float = HOURS, first: int = FIRST) -> Iterator[str]:
    """False alarms an hour, and how the statistic's peaks fall off: the average run length of a threshold."""
    seeds = math.ceil(hours * 12.0 / (len(AIRSPEEDS) * 2))
    jobs = [
        (name, air, first + 5000 + seed)
        for seed in range(seeds)
        for name in AIRSPEEDS
        for air in ("light", "moderate")
    ]
    flown, alarms, peaks = 0.0, 0, []
    with ProcessPoolExecutor(2) as pool:
        for each in pool.map(healthy, jobs):
            flown, alarms = flown + each.hours, alarms + each.alarms
            peaks.append(each.peaks)
            if each.text:
                print(each.text, flush=True)
    yield f"{flown:.1f} h without a fault, {alarms} alarms"
    if alarms == 0:
        yield f"(fewer than {3.0 / flown:.3f} an hour with 95 % confidence)"
    level = np.concatenate(peaks)
    yield "| log likelihood ratio | exceeded in an hour | average run length [h] |"
    yield "|---|---|---|"
    for threshold in range(4, 20, 2):
        count = float(np.sum(level > threshold)) / flown
        length = f"{1.0 / count:.3g}" if count else f"> {flown:.3g}"
        yield f"| {threshold} | {count:.3g} | {length} |"
    yield f"Threshold flown: {THRESHOLD}, meant for {AT} an hour."


def loss_level(size: float, job: tuple[str, str, int]) -> float:
    """Largest log likelihood ratio in the 2 s after a loss of thrust of a size."""
    name, air, seed = job
    given = overrides(name, air, seed, 40.0, None)
    lost = f'target="thrust",kind="loss-of-effectiveness",effectiveness={1.0 - size:.3f},start=30.0'
    given[-1] = f"fault=[{{{lost}}}]"
    try:
        row: Any = fly(
            load_scenario("nominal", [*given, "loop.isolation.false_alarms=1e-6"])
        ).record
    except UserError:
        return math.nan
    after = (row["time"] >= 30.0) & (row["time"] < 32.0)
    threshold = THRESHOLD - math.log(1e-6 / AT)
    return float(threshold * np.max(row["isolation_statistic"][after]))


def roc(seeds: int = 4, first: int = FIRST) -> Iterator[str]:
    """Part of losses found within 2 s, by threshold and size."""
    thresholds = (6, 8, 10, 12, 14, 16, 18, 22)
    yield "| loss | " + " | ".join(f"> {each}" for each in thresholds) + " |"
    yield "|---|" + "---|" * len(thresholds)
    with ProcessPoolExecutor(2) as pool:
        for size in (0.05, 0.1, 0.15, 0.2, 0.3):
            jobs = [
                (name, air, first + 9000 + seed)
                for seed in range(seeds)
                for name in AIRSPEEDS
                for air in ("light", "moderate")
            ]
            level = np.array([x for x in pool.map(partial(loss_level, size), jobs) if x == x])
            part = [f"{100.0 * np.mean(level > each):.0f} %" for each in thresholds]
            yield f"| {size} | " + " | ".join(part) + " |"


def residual_means(job: tuple[str, str, int]) -> npt.NDArray[np.float64]:
    """(blocks, spans, RESIDUALS) of a healthy flight in which nobody is ever suspected."""
    name, air, seed = job
    try:
        flown = assemble(load_scenario("nominal", overrides(name, air, seed, 120.0, None)))
    except UserError:
        return np.empty((0, len(SPANS), RESIDUALS))
    advance_rows, _ = advance(flown, ())
    loop: Any = flown.loop
    loop.arrays.settings[0]["isolation"]["threshold"] = 1e9
    windows = loop.arrays.state[0]["isolation"]["windows"]
    found, seen = [], 0
    for i in range(flown.record.size):
        advance_rows(i, i + 1)
        if windows["count"] != seen:
            seen = int(windows["count"])
            for span, blocks in enumerate(SPANS):
                if seen >= blocks:
                    look_back(windows, span)
                else:
                    windows["means"][span] = math.nan
            found.append(np.array(windows["means"]))
    flown.plant.close()
    return np.array(found)


def learn() -> Iterator[str]:
    """Standard deviations for scatter.py: the largest of the fighters."""
    squares = {}
    with ProcessPoolExecutor(2) as pool:
        for air in ("none", "moderate"):
            of_fighters = []
            for name in AIRSPEEDS:
                flights = pool.map(residual_means, [(name, air, seed) for seed in LEARNED])
                means = np.concatenate([each for each in flights if each.size])
                of_fighters.append(np.nanmean(means**2, axis=0))
                if name == "f15":  # its drag of sideslip is reckoned with apart
                    of_fighters[-1][:, FORCE] = 0.0
                print(name, air, np.sqrt(of_fighters[-1][[0, 3, 5]]).round(4), file=sys.stderr)
            squares[air] = MARGIN * np.max(of_fighters, axis=0)
    calm, gust = squares["none"], np.maximum(squares["moderate"] - squares["none"], 0.0)
    for title, square in (("CALM", calm), ("GUST", gust)):
        yield f"{title} = ("
        for row in np.sqrt(square):
            yield "    (" + ", ".join(f"{value:.2g}" for value in row) + "),"
        yield ")"


if __name__ == "__main__":
    numbers = [float(each) for each in sys.argv[2:]]
    whole = [int(each) for each in numbers]
    made = {
        "table": lambda: table(*whole),
        "rates": lambda: rates(*numbers[:1], *whole[1:]),
        "roc": lambda: roc(*whole),
        "learn": learn,
    }[sys.argv[1]]()
    for line in made:
        print(line, flush=True)
