"""From the faults in a row of the recording to the woven properties of JSBSim."""

from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.six_dof.properties import writer
from ftc_jsb.six_dof.weaving.engine_deck import EFFECTIVENESS
from ftc_jsb.six_dof.weaving.faults import THROTTLE_STATE, surface_effectiveness, surface_state
from ftc_jsb.vocabulary.channels import SURFACES


class FaultWriters:
    """Takes the faults of a recording's rows to the woven properties, where they change."""

    def __init__(
        self, fdm: Any, engines: int, record: npt.NDArray[Any], numbers: npt.NDArray[np.float64]
    ) -> None:
        """Args: loaded aircraft and its engines; recording; (rows, columns) of the same memory."""
        self._numbers = numbers
        columns = list(record.dtype.names or ())
        parts = [(f"engine_{k}", f"{EFFECTIVENESS}[{k}]") for k in range(engines)]
        parts += [(name, surface_effectiveness(name)) for name in SURFACES]
        self._writers = [(columns.index(f"{n}_effectiveness"), writer(fdm, p)) for n, p in parts]
        states = [(f"engine_{k}", f"{THROTTLE_STATE}[{k}]") for k in range(engines)]
        states += [(name, surface_state(name)) for name in SURFACES]
        self._writers += [(columns.index(f"{n}_state"), writer(fdm, p)) for n, p in states]
        self._first = min(column for column, _ in self._writers)
        self._beyond = max(column for column, _ in self._writers) + 1
        self._before = b""

    def write(self, i: int) -> None:
        """Put the faults of row `i` in force."""
        now = self._numbers[i, self._first : self._beyond]
        memory = now.tobytes()  # nan, of an engine that is not there, is equal to itself so
        if memory == self._before:
            return
        self._before = memory
        for column, write in self._writers:
            write(float(now[column - self._first]))
