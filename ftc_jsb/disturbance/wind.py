"""Wind: steady, with shear, with gusts, and turbulence for the point masses.

One kernel gives the wind of a sample to both plants. JSBSim makes its own turbulence (MIL-F-8785C);
the point masses fly through the Dryden spectra of the same report.
"""

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled
from ftc_jsb.disturbance.noise import normal
from ftc_jsb.scenario.schema import Wind
from ftc_jsb.units import FOOT

GUSTS = 8  # capacity

# MIL-F-8785C fig. 7: rms gust [ft/s] at altitudes [ft], for a probability of exceedance of 1e-2
# (light), 1e-3 (moderate) and 1e-5 (severe)
ALTITUDES = (500.0, 1750.0, 3750.0, 7500.0, 15000.0, 25000.0, 35000.0, 45000.0, 55000.0)
INTENSITY = {
    "light": (6.6, 6.9, 7.4, 6.7, 4.6, 2.7, 0.4, 0.0, 0.0),
    "moderate": (8.6, 9.6, 10.6, 10.1, 8.0, 6.6, 5.0, 4.2, 2.7),
    "severe": (15.6, 17.6, 23.0, 23.6, 22.1, 20.0, 16.0, 15.1, 12.1),
}
SCALE_LENGTH = 1750.0 * FOOT  # [m], above 2000 ft
LOW_ALTITUDE = 1000.0 * FOOT  # [m], below which scale lengths shrink with height
SEVERITY = {"light": 3, "moderate": 4, "severe": 6}  # JSBSim's numbers of those probabilities

WIND = np.dtype(
    [
        ("still", np.int64),  # 1: no wind at all
        ("steady", float, (3,)),  # north, east, up [m/s]
        ("shear", float, (2,)),  # north, east [1/s] for each metre above the reference altitude
        ("altitude", float),  # of reference [m]
        ("gusts", np.int64),
        ("gust", float, (GUSTS, 6)),  # north, east, up [m/s], start, length, hold [s]
        ("turbulence", float, (3,)),  # rms gust [m/s] along, across and normal to the path
        ("length", float),  # scale length of turbulence [m]
        ("seed", np.uint64),
        ("filter", float, (5,)),  # Dryden states: along, across (2), normal (2)
        ("now", float, (3,)),  # wind of the sample, north, east, up [m/s]
        ("rate", float, (3,)),  # its rate over the sample [m/s^2]
    ]
)


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
        w["length"] = SCALE_LENGTH if altitude > LOW_ALTITUDE else max(altitude, 30.0)
    w["seed"] = seed
    w["still"] = not (
        wind.speed or wind.shear or wind.gust or (dryden and wind.turbulence != "none")
    )
    return record


def intensity(turbulence: str, altitude: float) -> float:
    """Rms gust [m/s] at an altitude [m]."""
    return float(np.interp(altitude / FOOT, ALTITUDES, INTENSITY[turbulence]) * FOOT)


@compiled
def _deterministic(w: Any, axis: int, time: float, altitude: float) -> float:
    """Steady wind, shear and gusts along one axis [m/s]."""
    total = w.steady[axis]
    if axis < 2:
        total += w.shear[axis] * (altitude - w.altitude)
    for g in range(w.gusts):
        start, length, hold = w.gust[g, 3], w.gust[g, 4], w.gust[g, 5]
        elapsed = time - start
        if elapsed <= 0.0 or elapsed >= 2.0 * length + hold:
            continue
        share = 1.0  # 1 - cosine up, held, and down again
        if elapsed < length:
            share = 0.5 * (1.0 - math.cos(math.pi * elapsed / length))
        elif elapsed > length + hold:
            share = 0.5 * (1.0 + math.cos(math.pi * (elapsed - length - hold) / length))
        total += share * w.gust[g, axis]
    return float(total)


@compiled
def _dryden_step(w: Any, i: int, airspeed: float, dt: float) -> None:
    """Advance the Dryden filters by one sample, exact for white noise held over it.

    Along the path sigma sqrt(2 L/V) / (1 + L/V s); across and normal to it
    sigma sqrt(L/V) (1 + sqrt(3) L/V s) / (1 + L/V s)^2 (MIL-F-8785C, 3.7.2).
    """
    x = w.filter
    tau = w.length / airspeed
    decay = math.exp(-dt / tau)
    density = 1.0 / math.sqrt(dt)  # of white noise of unit intensity
    x[0] = decay * x[0] + (1.0 - decay) * math.sqrt(2.0 * tau) * density * normal(w.seed, 0, i)
    for axis in range(2):
        a, b = 1 + 2 * axis, 2 + 2 * axis
        noise = math.sqrt(tau) * density * normal(w.seed, 1 + axis, i)
        first = x[a]  # two equal lags in a row
        x[a] = decay * first + (1.0 - decay) * noise
        x[b] = decay * x[b] + (1.0 - decay) * noise
        # the second lag of the first, exact for the held input
        x[b] += dt / tau * decay * (first - noise)


@compiled
def wind_step(wind: Any, record: Any, i: int, dt: float) -> None:
    """Wind at the start of sample `i` and its rate over the sample.

    Args:
        wind: (1,) WIND, advanced.
        record: (rows,) of the recording; time, altitude and path of row `i` are read.
        i: row.
        dt: sample time [s].
    """
    w, row = wind[0], record[i]
    if w.still == 1:
        return
    sg, cg = math.sin(row.flight_path_angle), math.cos(row.flight_path_angle)
    sh, ch = math.sin(row.heading), math.cos(row.heading)
    turbulent = w.turbulence[0] > 0.0
    later = row.altitude + row.airspeed * sg * dt
    x = w.filter
    s3 = math.sqrt(3.0)
    for moment in range(2):  # now, and at the end of the sample
        time, altitude = (row.time, row.altitude) if moment == 0 else (row.time + dt, later)
        north = _deterministic(w, 0, time, altitude)
        east = _deterministic(w, 1, time, altitude)
        up = _deterministic(w, 2, time, altitude)
        if turbulent:
            along = w.turbulence[0] * x[0]
            across = w.turbulence[1] * (x[2] + s3 * (x[1] - x[2]))
            normally = w.turbulence[2] * (x[4] + s3 * (x[3] - x[4]))
            north += along * cg * ch - across * sh - normally * sg * ch
            east += along * cg * sh + across * ch - normally * sg * sh
            up += along * sg + normally * cg
        if moment == 0:
            w.now[0], w.now[1], w.now[2] = north, east, up
            if turbulent:
                _dryden_step(w, i, row.airspeed, dt)
        else:
            w.rate[0] = (north - w.now[0]) / dt
            w.rate[1] = (east - w.now[1]) / dt
            w.rate[2] = (up - w.now[2]) / dt
