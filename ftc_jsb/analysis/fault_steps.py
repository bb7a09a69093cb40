"""When the effectiveness of a channel jumps."""

import numpy as np
import numpy.typing as npt

from ftc_jsb.disturbance.faults import TIME_TOLERANCE
from ftc_jsb.scenario.schema import Scenario

SETTLING = 2.0  # [s] after the start and after a fault step, in which no estimate is judged


def fault_steps(truth: npt.NDArray[np.float64], scenario: Scenario) -> npt.NDArray[np.int64]:
    """Rows at which an effectiveness jumps: by more than the scenario's steepest ramp would.

    Args:
        truth: (rows,) of one channel.
        scenario: that was flown.
    """
    row = scenario.simulation.record_every / scenario.loop.rate  # [s], at most
    ramps = [
        (1.0 - fault.effectiveness) / fault.rise * row
        for fault in scenario.fault
        if fault.effectiveness is not None and fault.rise is not None
    ]
    steepest = 1.001 * max(ramps, default=0.0) + TIME_TOLERANCE
    known = np.nan_to_num(truth, nan=-1.0)  # where it is not known counts as another value
    return (np.flatnonzero(np.abs(np.diff(known)) > steepest) + 1).astype(np.int64)
