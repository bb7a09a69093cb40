"""`ftc_jsb/isolation/scatter.py` anew: standard deviations of the residuals where nothing is wrong."""

import math
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.errors import UserError
from ftc_jsb.isolation.records import FORCE, RESIDUALS, SPANS
from ftc_jsb.isolation.windows import look_back
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.advance import advance
from ftc_jsb.simulation.assembly import assemble
from validation.envelope import AIRSPEEDS
from validation.isolation.flights import Mission, overrides

LEARNED = range(100, 104)  # seeds
DURATION = 120.0  # [s]
MARGIN = 1.2  # on variances: other flights than those of learning are flown


def residual_means(mission: Mission) -> npt.NDArray[np.float64]:
    """(blocks, spans, RESIDUALS) of a healthy flight in which nobody is ever suspected."""
    try:
        flown = assemble(load_scenario("nominal", overrides(mission)))
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
                flights = pool.map(
                    residual_means,
                    [Mission(name, air, seed, duration=DURATION) for seed in LEARNED],
                )
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
