"""Flights that are measured: one of a scenario, or a seeded random manoeuvre."""

import json
import time
from typing import Any

import numpy as np

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.errors import UserError
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly


def measured(scenario: str, *overrides: str) -> dict[str, Any]:
    """Metrics of one flight, and the seconds it took."""
    started = time.perf_counter()
    flight = fly(load_scenario(scenario, overrides))
    elapsed = time.perf_counter() - started
    if flight.outcome.status != "complete":
        raise UserError(f"{scenario} {overrides}: {flight.outcome.status}: {flight.outcome.reason}")
    late = np.abs(flight.record["effectiveness_thrust_est"] - flight.record["effectiveness_thrust"])
    wrong = np.flatnonzero(~(late <= 0.01))
    return {
        **flight_metrics(flight),
        "last_wrong_s": float(flight.record["time"][wrong[-1]]) if wrong.size else 0.0,
        "elapsed_s": elapsed,
    }


def random_manoeuvre(seed: int) -> list[str]:
    """A seeded manoeuvre: turns at 2-6 deg/s to +-40 deg, climbs to +-6 deg, a loss of thrust.

    220-300 m/s, 2500-5000 m, effectiveness 0.6-0.9 from 10-40 s: what 0.6 of the F-16's thrust
    can pay for.
    """
    random = np.random.default_rng(seed)
    airspeed = round(float(random.uniform(220.0, 300.0)), 1)
    heading = _profile(random, 3.0, (2.0, 6.0), 40.0)
    path = _profile(random, 5.0, (0.4, 1.5), 6.0)
    return [
        f"initial.airspeed={airspeed}",
        f"reference.airspeed=[[0, {airspeed}]]",
        f"initial.altitude={random.uniform(2500.0, 5000.0):.0f}",
        f"reference.heading_deg={json.dumps(heading)}",
        f"reference.flight_path_deg={json.dumps(path)}",
        f"fault[0].effectiveness={random.uniform(0.6, 0.9):.3f}",
        f"fault[0].start={random.uniform(10.0, 40.0):.1f}",
    ]


def _profile(
    random: np.random.Generator, start: float, rates: tuple[float, float], amplitude: float
) -> list[list[float]]:
    points, now, value = [[0.0, 0.0]], start, 0.0
    while now < 55.0:
        following = round(float(random.uniform(-amplitude, amplitude)), 2)
        duration = abs(following - value) / random.uniform(*rates) + 0.5
        points += [[round(now, 2), value], [round(now + duration, 2), following]]
        value = following
        now += duration + random.uniform(0.5, 6.0)
    return points
