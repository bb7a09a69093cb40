"""[wind] of a scenario as the record that the wind kernel takes."""

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.disturbance.wind import WIND
from ftc_jsb.scenario.wind import Wind
from ftc_jsb.units import FOOT

# MIL-F-8785C fig. 7: rms gust [ft/s] at altitudes [ft], for a probability of exceedance of 1e-2
# (light), 1e-3 (moderate) and 1e-5 (severe)
ALTITUDES = (500.0, 1750.0, 3750.0, 7500.0, 15000.0, 25000.0, 35000.0, 45000.0, 55000.0)
INTENSITY = {
    "light": (6.6, 6.9, 7.4, 6.7, 4.6, 2.7, 0.4, 0.0, 0.0),
    "moderate": (8.6, 9.6, 10.6, 10.1, 8.0, 6.6, 5.0, 4.2, 2.7),
    "severe": (15.6, 17.6, 23.0, 23.6, 22.1, 20.0, 16.0, 15.1, 12.1),
}
SCALE_LENGTH = 1750.0 * FOOT  # [m], above 2000 ft
LOW, HIGH = 1000.0, 2000.0  # [ft]: between, scale lengths go from one rule to the other
SEVERITY = {"light": 3, "moderate": 4, "severe": 6}  # JSBSim's numbers of those probabilities


def wind_record(wind: Wind, altitude: float, seed: int, dryden: bool) -> npt.NDArray[Any]:
    """(1,) WIND of a flight.

    Args:
        wind: of the scenario.
        altitude: at the start [m].
        seed: of the turbulence.
        dryden: turbulence by the Dryden spectra; otherwise the plant makes its own.
    """
    record = np.zeros(1, WIND)
    w = record[0]
    towards = math.radians(wind.from_deg) + math.pi
    direction = (math.cos(towards), math.sin(towards))
    w["steady"][:2] = np.multiply(direction, wind.speed)
    w["shear"] = np.multiply(direction, wind.shear)
    w["altitude"] = altitude
    w["gusts"] = len(wind.gust)
    for index, gust in enumerate(wind.gust):
        way = math.radians(gust.from_deg) + math.pi
        level = (gust.speed * math.cos(way), gust.speed * math.sin(way))
        w["gust"][index] = (*level, gust.updraught, gust.start, gust.length, gust.hold)
    if dryden and wind.turbulence != "none":
        w["turbulence"] = intensity(wind.turbulence, altitude)
        w["length"] = scale_length(altitude)
    w["seed"] = seed
    w["still"] = not (
        wind.speed or wind.shear or wind.gust or (dryden and wind.turbulence != "none")
    )
    return record


def scale_length(altitude: float) -> float:
    """Scale length of turbulence [m] at an altitude [m]: MIL-F-8785C, 3.7.3, the level one near the ground."""
    height = max(altitude / FOOT, 10.0)
    if height <= LOW:
        return float(height / (0.177 + 0.000823 * height) ** 1.2 * FOOT)
    return float(np.interp(height, (LOW, HIGH), (LOW * FOOT, SCALE_LENGTH)))


def intensity(turbulence: str, altitude: float) -> float:
    """Rms gust [m/s] at an altitude [m]."""
    return float(np.interp(altitude / FOOT, ALTITUDES, INTENSITY[turbulence]) * FOOT)
