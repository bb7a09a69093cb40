"""Wind: steady, with shear, with gusts, and turbulence for the point masses.

One kernel gives the wind of a sample to both plants. JSBSim makes its own turbulence (MIL-F-8785C);
the point masses fly through the Dryden spectra of the same report.
"""

import math
from typing import Any

import numpy as np

from ftc_jsb.compiled import compiled
from ftc_jsb.disturbance.noise import normal
from ftc_jsb.vocabulary.kernel_types import Records, WindRecord

GUSTS = 8  # capacity

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


@compiled
def _deterministic(w: WindRecord, axis: int, time: float, altitude: float) -> float:
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
def _dryden_step(w: WindRecord, i: int, airspeed: float, dt: float) -> None:
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
def wind_step(wind: Any, record: Records, i: int, dt: float) -> None:
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
