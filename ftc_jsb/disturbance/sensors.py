"""Sensors: from the truth in a row of the recording to what the outer loop sees of it.

Between either plant and the outer loop stands this one step. Perfect sensors pass the truth on.
Others read at their own rate, late, with noise and bias, and can fail; flight path angle, heading,
load factor and bank are then computed from what attitude, vanes and accelerometers say, as on an
aircraft.
"""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled
from ftc_jsb.disturbance.faults import (
    BIAS,
    DELAY,
    DRIFT,
    DROPOUT,
    FIRST_SENSOR,
    FREEZE,
    NOISE,
    TARGETS,
    severity,
)
from ftc_jsb.disturbance.noise import normal
from ftc_jsb.disturbance.sensor_profiles import PROFILES, Errors
from ftc_jsb.frames import measure_force, measure_path
from ftc_jsb.scenario.faults import Fault
from ftc_jsb.scenario.sensors import Sensor, Sensors
from ftc_jsb.vocabulary.kernel_types import Numbers, Records
from ftc_jsb.vocabulary.signals import SIGNALS

COUNT = len(SIGNALS)
FIRST_STREAM = 16  # of random numbers: those before are the wind's

SENSORS = np.dtype(
    [
        ("perfect", np.int64),
        ("seed", np.int64),
        ("noise", float, (COUNT,)),  # SI and rad from here on
        ("bias", float, (COUNT,)),  # of this flight
        ("period", float, (COUNT,)),  # [s] between readings; 0 = every sample
        ("delay", float, (COUNT,)),  # [s]
        ("truth", np.int64, (COUNT,)),  # column of the recording that is read
        ("measured", np.int64, (COUNT,)),  # and the one that is written
        ("last", float, (COUNT,)),  # readings of the sample before
    ]
)


class Instruments(NamedTuple):
    """What is measured with: instruments, their faults, and the recording that they read and write."""

    sensors: npt.NDArray[Any]  # (1,) SENSORS
    faults: npt.NDArray[Any]  # (n,) FAULT
    record: npt.NDArray[Any]  # (rows,) of the recording
    table: npt.NDArray[np.float64]  # (rows, columns), the same memory as numbers


def sensor_errors(sensors: Sensors) -> dict[str, Errors]:
    """Errors of every signal: the profile's, with what [sensors] replaces; angles in degrees."""
    result = {}
    for signal in SIGNALS:
        errors = PROFILES[sensors.profile].get(signal.name, Errors())
        own: Sensor | None = getattr(sensors, signal.name)
        if own is not None:
            unit = "_deg" if signal.angle else ""
            given = {key: getattr(own, key + unit) for key in ("noise", "bias", "bias_spread")}
            given |= {"rate": own.rate, "delay": own.delay}
            errors = errors._replace(**{k: v for k, v in given.items() if v is not None})
        result[signal.name] = errors
    return result


def sensor_record(
    sensors: Sensors, seed: int, record: npt.NDArray[Any], faults: Sequence[Fault] = ()
) -> npt.NDArray[Any]:
    """(1,) SENSORS for a recording; biases are drawn from the seed.

    Args:
        sensors: [sensors] of the scenario.
        seed: of noise and biases.
        record: whose columns are read and written.
        faults: of the scenario; a fault of a sensor makes perfect ones imperfect.
    """
    result = np.zeros(1, SENSORS)
    s = result[0]
    s["seed"] = seed
    columns = list(record.dtype.names or ())
    errors = sensor_errors(sensors)
    for index, (signal, error) in enumerate(zip(SIGNALS, errors.values(), strict=True)):
        unit = math.radians(1.0) if signal.angle else 1.0
        drawn = normal(seed, FIRST_STREAM + COUNT + index, 0)
        s["noise"][index] = error.noise * unit
        s["bias"][index] = (error.bias + error.bias_spread * drawn) * unit
        s["period"][index] = 1.0 / error.rate if error.rate > 0.0 else 0.0
        s["delay"][index] = error.delay
        name = signal.column or signal.name
        s["truth"][index] = columns.index(name)
        s["measured"][index] = columns.index(f"{name}_meas")
    failing = any(TARGETS.index(fault.target) >= FIRST_SENSOR for fault in faults)
    s["perfect"] = all(error == Errors() for error in errors.values()) and not failing
    return result


@compiled
def measure(instruments: Instruments, i: int) -> None:
    """Write what the aircraft measures at the start of sample `i`; rows up to `i` are read."""
    table = instruments.table
    s, row = instruments.sensors[0], instruments.record[i]
    for k in range(COUNT):
        if s.perfect == 1:
            table[i, s.measured[k]] = table[i, s.truth[k]]
        else:
            table[i, s.measured[k]] = _reading(instruments, i, k)
        s.last[k] = table[i, s.measured[k]]
    if s.perfect == 1:
        row.flight_path_angle_meas, row.heading_meas = row.flight_path_angle, row.heading
        row.load_factor_meas, row.bank_angle_meas = row.load_factor, row.bank_angle
        measure_force(row)
    else:
        measure_path(row)


@compiled
def _reading(instruments: Instruments, i: int, k: int) -> float:
    """What signal `k` reads at row `i`."""
    s, faults = instruments.sensors[0], instruments.faults
    record, table = instruments.record, instruments.table
    now = record[i].time
    noise, late, offset = s.noise[k], s.delay[k], s.bias[k]
    for f in range(faults.size):
        fault = faults[f]
        if fault.kind == 0 or fault.target != FIRST_SENSOR + k:
            continue
        amount = severity(fault, now)
        if amount == 0.0:
            continue
        if fault.kind == DROPOUT:
            return math.nan
        if fault.kind == FREEZE and i > 0:
            return float(s.last[k])
        if fault.kind == BIAS:
            offset += amount * fault.value
        elif fault.kind == NOISE:
            noise = math.sqrt(noise * noise + (amount * fault.value) ** 2)
        elif fault.kind == DRIFT:
            offset += fault.value * (now - fault.start)
        elif fault.kind == DELAY:
            late += fault.value
    read, count = now, i
    if s.period[k] > 0.0:
        count = math.floor(now / s.period[k] + 1e-6)
        read = count * s.period[k]
    value = _at(record, table, i, s.truth[k], read - late) + offset
    if noise > 0.0:
        value += noise * normal(s.seed, FIRST_STREAM + k, count)
    return float(value)


@compiled
def _at(record: Records, table: Numbers, i: int, column: int, time: float) -> float:
    """Truth at an earlier time, linear between the rows up to `i`."""
    if i == 0 or time <= record[0].time:
        return float(table[0, column])
    step = record[1].time - record[0].time
    place = (time - record[0].time) / step
    before = min(math.floor(place + 1e-6), i)
    part = place - before
    if part < 1e-6 or before == i:
        return float(table[before, column])
    return float(table[before, column] * (1.0 - part) + table[before + 1, column] * part)
