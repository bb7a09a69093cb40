"""Losses of thrust that are found within two seconds, by size and threshold: the receiver operating curve.

The other axis, alarms by chance, is `rates`: both go by the same log likelihood ratio.
"""

import math
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from typing import Any

import numpy as np

from ftc_jsb.errors import UserError
from ftc_jsb.loops.isolation_settings import threshold
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from validation.envelope import AIRSPEEDS
from validation.isolation.flights import FIRST, Mission, overrides

SEEDS = 4
SIZES = (0.05, 0.1, 0.15, 0.2, 0.3)
THRESHOLDS = (6, 8, 10, 12, 14, 16, 18, 20, 22)
RARE = 1e-6  # false alarms an hour: so that no decision changes what follows
START, WITHIN = 30.0, 2.0  # [s]


def loss_level(size: float, mission: Mission) -> float:
    """Largest log likelihood ratio in the 2 s after a loss of thrust of a size; nan without a trim."""
    given = overrides(mission)
    lost = (
        f'target="thrust",kind="loss-of-effectiveness",effectiveness={1.0 - size:.3f},start={START}'
    )
    given[-1] = f"fault=[{{{lost}}}]"
    try:
        row: Any = fly(
            load_scenario("nominal", [*given, f"loop.isolation.false_alarms={RARE}"])
        ).record
    except UserError:
        return math.nan
    after = (row["time"] >= START) & (row["time"] < START + WITHIN)
    return float(threshold(RARE) * np.max(row["isolation_statistic"][after]))


def roc(seeds: int = SEEDS, first: int = FIRST + 9000) -> Iterator[str]:
    """Part of the losses found, a line for each size."""
    yield "| loss | " + " | ".join(f"> {each}" for each in THRESHOLDS) + " |"
    yield "|---|" + "---|" * len(THRESHOLDS)
    with ProcessPoolExecutor(2) as pool:
        for size in SIZES:
            missions = [
                Mission(name, air, first + seed, duration=START + WITHIN)
                for seed in range(seeds)
                for name in AIRSPEEDS
                for air in ("light", "moderate")
            ]
            found = pool.map(partial(loss_level, size), missions)
            level = np.array([each for each in found if not math.isnan(each)])
            part = [f"{100.0 * np.mean(level > each):.0f} %" for each in THRESHOLDS]
            yield f"| {size} | " + " | ".join(part) + " |"
