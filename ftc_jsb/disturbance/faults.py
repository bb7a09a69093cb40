"""Faults as records, and the schedule that they write into the recording.

A scenario's faults and those injected in flight are the same FAULT records. What acts on the
aircraft is written to the rows of the recording before they are flown; what acts on a sensor is
asked for by `sensors.py` as it measures.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled, direct
from ftc_jsb.scenario.faults import Fault
from ftc_jsb.vocabulary.channels import CHANNELS, ENGINES, SURFACES
from ftc_jsb.vocabulary.kernel_types import FaultRecords, Matrix, Vector
from ftc_jsb.vocabulary.signals import SENSED

TIME_TOLERANCE = 1e-9  # [s]: 0.1 x 3 counts as 0.3
CAPACITY = 32  # faults of one flight, injected ones included

LOSS, FLAME_OUT, STUCK, HARD_OVER, BIAS, NOISE, DRIFT, FREEZE, DROPOUT, DELAY = range(1, 11)
KINDS = {
    "loss-of-effectiveness": LOSS,
    "flame-out": FLAME_OUT,
    "stuck": STUCK,
    "hard-over": HARD_OVER,
    "bias": BIAS,
    "noise": NOISE,
    "drift": DRIFT,
    "freeze": FREEZE,
    "dropout": DROPOUT,
    "delay": DELAY,
}

# State of an engine or a surface in the recording
HEALTHY, ENGINE_OUT, HELD, OVER_POSITIVE, OVER_NEGATIVE = range(5)

TARGETS: tuple[str, ...] = (
    *CHANNELS,
    *(f"engine[{number}]" for number in range(ENGINES)),
    *SURFACES,
    *SENSED,
)
FIRST_ENGINE = len(CHANNELS)
FIRST_SURFACE = FIRST_ENGINE + ENGINES
FIRST_SENSOR = FIRST_SURFACE + len(SURFACES)

FAULT = np.dtype(
    [
        ("kind", np.int64),  # 0 = none
        ("target", np.int64),  # place in TARGETS
        ("start", float),  # [s]
        ("end", float),  # [s]; inf = lasts
        ("rise", float),  # [s] of a ramp; 0 = step
        ("fall", float),  # [s] of a ramp from the end on; 0 = step
        ("period", float),  # [s] of an intermittent fault; 0 = it stays
        ("duty", float),
        # effectiveness that is left, direction of a hard-over, or what the sensor is off by:
        # bias, standard deviation, drift a second in the signal's unit, delay in s
        ("value", float),
    ]
)


def fault_records(faults: Sequence[Fault]) -> npt.NDArray[Any]:
    """(CAPACITY,) FAULT of a scenario's faults, the rest empty."""
    records = np.zeros(CAPACITY, FAULT)
    for index, fault in enumerate(faults):
        records[index] = fault_record(fault)
    return records


def fault_record(fault: Fault) -> npt.NDArray[Any]:
    """One fault of the scenario as a FAULT record."""
    record = np.zeros((), FAULT)
    record["kind"] = KINDS[fault.kind]
    record["target"] = TARGETS.index(fault.target)
    record["start"] = fault.start
    record["end"] = math.inf if fault.end is None else fault.end
    record["rise"], record["fall"] = fault.rise or 0.0, fault.fall or 0.0
    record["period"], record["duty"] = fault.period or 0.0, fault.duty or 0.0
    record["value"] = fault.value
    return record


@compiled
def severity(fault: Any, time: float) -> float:
    """How much of a fault is there at a time [s], 0 to 1.

    A fault acts from the first sample at or after its start, and no longer from its end on, or from there
    falls in `fall`.
    """
    elapsed = time - fault.start + TIME_TOLERANCE
    if elapsed < 0.0:
        return 0.0
    over = time - fault.end + TIME_TOLERANCE
    if over >= fault.fall:
        return 0.0
    left = 1.0
    if over > 0.0:
        left = 1.0 - over / fault.fall
        elapsed = fault.end - fault.start
    if fault.period > 0.0 and elapsed % fault.period >= fault.duty * fault.period:
        return 0.0
    if fault.rise > 0.0:
        return float(left * min(elapsed / fault.rise, 1.0))
    return left


@compiled
def present(faults: FaultRecords, time: float, engines: int, columns: Vector) -> None:
    """What is faulty at one time.

    Losses of one target multiply. Of engines and surfaces the recording has the state besides; an
    engine that is out has effectiveness 0, and the thrust of one whose throttle is stuck has no
    effectiveness that could be told (nan).

    Args:
        faults: (n,) FAULT.
        time: [s].
        engines: that the aircraft has; they share the thrust equally, and a loss of the channel
            `thrust` is a loss of each.
        columns: (len(SCHEDULE),), written: effectiveness of the channels, effectiveness of
            engines and surfaces, state of engines and surfaces.
    """
    parts = ENGINES + len(SURFACES)
    state = FIRST_SENSOR
    for k in range(FIRST_SENSOR):
        columns[k] = 1.0
    for k in range(parts):
        columns[state + k] = HEALTHY
    for f in range(faults.size):
        fault = faults[f]
        target = fault.target
        if fault.kind == 0 or target >= FIRST_SENSOR:
            continue
        amount = severity(fault, time)
        if fault.kind == LOSS:
            columns[target] *= 1.0 - (1.0 - fault.value) * amount
        elif amount > 0.0:
            place = state + target - FIRST_ENGINE
            if fault.kind == FLAME_OUT:
                columns[place] = ENGINE_OUT
            elif fault.kind == STUCK:
                columns[place] = HELD
            else:
                columns[place] = OVER_POSITIVE if fault.value > 0.0 else OVER_NEGATIVE
    total = 0.0
    for k in range(ENGINES):
        engine = FIRST_ENGINE + k
        columns[engine] = columns[engine] * columns[0] if k < engines else math.nan
        if columns[state + k] == ENGINE_OUT:
            columns[engine] *= 0.0
        if k < engines:
            total += math.nan if columns[state + k] == HELD else columns[engine]
    columns[0] = total / engines


SCHEDULE: tuple[str, ...] = (
    *(f"effectiveness_{name}" for name in CHANNELS),
    *(f"engine_{number}_effectiveness" for number in range(ENGINES)),
    *(f"{name}_effectiveness" for name in SURFACES),
    *(f"engine_{number}_state" for number in range(ENGINES)),
    *(f"{name}_state" for name in SURFACES),
)


@compiled
def _scheduled(faults: FaultRecords, times: Vector, engines: int, table: Matrix) -> None:
    for i in range(times.size):
        present(faults, times[i], engines, table[i])


def schedule(
    faults: npt.NDArray[Any], engines: int, record: npt.NDArray[Any], first: int = 0
) -> None:
    """Write what the faults do to the aircraft to rows `first` and later of a recording.

    Args:
        faults: (n,) FAULT.
        engines: that the aircraft has.
        record: (rows,) of the recording; `time` must be there.
        first: row.
    """
    times = np.ascontiguousarray(record["time"][first:])
    columns = record.dtype.names or ()
    place = columns.index(SCHEDULE[0])  # they stand side by side
    width = len(columns)
    table = record.view(np.float64).reshape(-1, width)[first:, place : place + len(SCHEDULE)]
    direct(_scheduled, faults, times, engines, table)(faults, times, engines, table)
