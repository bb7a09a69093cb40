"""What kernels take: names that tell a reader what an argument is.

Numba compiles for the types that it is given, so that these are `Any` to a type checker. A record is one
element of a structured array, handed over by reference: a kernel changes it in place.
"""

from typing import Any

Records = Any  # (rows,) of `recording.columns.ROW`: the recording
Row = Any  # one row of it
Numbers = Any  # (rows, columns): the recording's memory as plain numbers
ModelRecord = Any  # `point_mass.model.MODEL`
WindRecord = Any  # `disturbance.wind.WIND`
FaultRecords = Any  # (n,) `disturbance.faults.FAULT`
LoopSettings = Any  # `control.records.LOOP_SETTINGS`
LoopState = Any  # `control.records.LOOP_STATE`
Observer = Any  # `control.records.OBSERVER`
IsolationSettings = Any  # `isolation.records.ISOLATION_SETTINGS`
IsolationState = Any  # `isolation.records.ISOLATION`
Windows = Any  # `isolation.records.WINDOWS`
Filter = Any  # `estimation.process.FILTER`
Vector = Any  # (n,) of floats
Matrix = Any  # (n, m) of floats
