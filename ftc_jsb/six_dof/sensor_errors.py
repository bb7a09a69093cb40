"""From the measurements in a row of the recording to the errors that the woven inner loop reads."""

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled, direct
from ftc_jsb.six_dof.properties import writer
from ftc_jsb.six_dof.weaving.measured_signals import MEASURED
from ftc_jsb.units import FOOT
from ftc_jsb.vocabulary.kernel_types import Numbers, Vector

COLUMNS = (  # of the recording, in the order of MEASURED, but for the angular accelerations
    "airspeed",
    "alpha",
    "sideslip",
    "roll",
    "pitch",
    "roll_rate",
    "pitch_rate",
    "yaw_rate",
    "load_factor_x",
    "load_factor_y",
    "load_factor_z",
)
FIRST_RATE = COLUMNS.index("roll_rate")
RATE_FILTER = 20.0  # [1/s]: angular accelerations are the gyros' rates, differentiated behind it

SENSOR_ERRORS = np.dtype(
    [
        ("truth", np.int64, (len(COLUMNS),)),  # columns
        ("measured", np.int64, (len(COLUMNS),)),
        ("share", float),  # of the way that the rates' filter goes in a sample
        ("last", float, (len(COLUMNS),)),  # readings: a silent sensor keeps its last
        ("slow", float, (3,)),  # errors of the rates behind the filter [rad/s]
    ]
)


class SensorErrors:
    """Takes the sensors' errors to the inner loop, sample by sample."""

    def __init__(
        self, fdm: Any, record: npt.NDArray[Any], numbers: npt.NDArray[np.float64], dt: float
    ) -> None:
        """Args: loaded aircraft; recording; (rows, columns) of the same memory; sample time [s]."""
        self._writers = [writer(fdm, error) for _, error in MEASURED.values()]
        self._out = np.zeros(len(MEASURED))
        self._state = np.zeros(1, SENSOR_ERRORS)
        columns = list(record.dtype.names or ())
        state = self._state[0]
        state["truth"] = [columns.index(name) for name in COLUMNS]
        state["measured"] = [columns.index(f"{name}_meas") for name in COLUMNS]
        state["share"] = 1.0 - math.exp(-RATE_FILTER * dt)
        self._numbers = numbers
        given = (self._state, numbers, 0, self._out)
        self._read = direct(sensor_errors, *given)

    def write(self, i: int) -> None:
        """Put the errors of row `i` in force."""
        self._read(self._state, self._numbers, i, self._out)
        for write, error in zip(self._writers, self._out.tolist(), strict=True):
            write(error)


@compiled
def sensor_errors(states: Any, table: Numbers, i: int, out: Vector) -> None:
    """Measured less true, in the inner loop's units and the order of MEASURED.

    Args:
        states: (1,) SENSOR_ERRORS, advanced.
        table: (rows, columns) of the recording.
        i: row.
        out: (14,), written.
    """
    s = states[0]
    for k in range(len(COLUMNS)):
        truth, reading = table[i, s.truth[k]], table[i, s.measured[k]]
        if not math.isfinite(reading):
            reading = s.last[k] if i > 0 else truth
        s.last[k] = reading
        out[k] = reading - truth
    out[0] /= FOOT
    for k in range(3):
        error = out[FIRST_RATE + k]
        if i == 0:
            s.slow[k] = error
        out[len(COLUMNS) + k] = RATE_FILTER * (error - s.slow[k])
        s.slow[k] += s.share * (error - s.slow[k])
