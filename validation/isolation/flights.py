"""The flights that isolation is judged by: a mission of each fighter, with a fault of a class or none."""

import json
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from validation.envelope import AIRSPEEDS, ALTITUDES

AIR = ("none", "light", "moderate", "severe")
FIRST = 17000  # seed: nothing was chosen by these flights
Random = np.random.Generator
Draw = Callable[[Random], dict[str, Any]]


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


def _loss(target: str, low: float = 0.3, high: float = 0.8) -> Draw:
    return lambda random: {
        "target": target,
        "kind": "loss-of-effectiveness",
        "effectiveness": round(float(random.uniform(low, high)), 2),
    }


CLASSES: dict[str, Draw] = {
    "thrust": _loss("thrust"),
    "elevator loses 0.2 to 0.7": _loss("elevator"),
    "aileron loses 0.2 to 0.7": _loss("aileron"),
    "rudder loses 0.2 to 0.7": _loss("rudder"),
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
    "elevator pick-off bias 1 to 4°": _sensor("elevator_position", "bias", 1.0, 4.0),
}
HEALTHY = "none"

PERIOD = 120.0  # [s], after which the mission is flown again


class Mission(NamedTuple):
    """What is flown."""

    aircraft: str
    air: str  # turbulence
    seed: int
    sensors: str = "tactical"
    duration: float = 60.0  # [s]


def overrides(mission: Mission, fault: str = HEALTHY) -> list[str]:
    """Overrides of `nominal`: the mission, and a fault of a class at 15 to 35 s."""
    name, air, seed, sensors, duration = mission
    random = np.random.default_rng([seed, list(AIRSPEEDS).index(name), AIR.index(air)])
    slowest, fastest = AIRSPEEDS[name]
    speed = round(float(random.uniform(slowest, 0.9 * fastest)))
    later = round(float(speed * random.uniform(0.95, 1.1)))
    begins, climb = random.uniform(5.0, 20.0), random.uniform(-6.0, 6.0)
    path = [(0, 0), (begins, 0), (begins + 6, climb), (begins + 18, climb), (begins + 24, 0)]
    path += [(begins + 50, 0), (begins + 56, -climb), (begins + 70, -climb), (begins + 76, 0)]
    turning, turn = random.uniform(5.0, 30.0), random.uniform(-90.0, 90.0)
    there = turning + abs(turn) / random.uniform(2.0, 6.0) + 0.1
    back = turning + 45.0 + abs(turn) / 3.0 + 0.1
    heading = [(0, 0), (turning, 0), (there, turn), (turning + 45.0, turn), (back, 0)]
    airspeed = [(0, speed), (30, speed), (40, later), (70, later), (80, speed)]
    faults = []
    if fault != HEALTHY:
        faults = [CLASSES[fault](random) | {"start": round(float(random.uniform(15.0, 35.0)), 1)}]
    listed = [
        "{" + ", ".join(f"{key} = {json.dumps(value)}" for key, value in each.items()) + "}"
        for each in faults
    ]
    return [
        "model=jsbsim",
        "loop.name=robust",
        f"sensors.profile={sensors}",
        f"aircraft.name={name}",
        f"duration={duration}",
        f"seed={seed}",
        f"initial.airspeed={speed}",
        f"initial.altitude={random.uniform(*ALTITUDES):.0f}",
        f"reference.airspeed={_repeated(airspeed, duration)}",
        f"reference.flight_path_deg={_repeated(path, duration)}",
        f"reference.heading_deg={_repeated(heading, duration)}",
        f"wind.turbulence={air}",
        f"fault=[{', '.join(listed)}]",
    ]


def _repeated(points: list[tuple[float, float]], duration: float) -> str:
    """Breakpoints, again every PERIOD."""
    times = max(math.ceil(duration / PERIOD), 1)
    return json.dumps([[k * PERIOD + time, value] for k in range(times) for time, value in points])
