"""Loss of effectiveness over time, from the scenario's faults."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ftc_jsb.scenario.schema import Channel, Fault, Scenario

CHANNELS: tuple[Channel, ...] = ("thrust", "load_factor", "bank_angle")
TIME_TOLERANCE = 1e-9  # [s]: 0.1 x 3 counts as 0.3


def effectiveness(
    faults: Sequence[Fault], times: npt.NDArray[np.float64]
) -> npt.NDArray[np.float64]:
    """Effectiveness of the three channels at each sample, held until the next.

    Faults of one channel multiply. A fault acts from the first sample at or after its start.

    Args:
        faults: of the scenario.
        times: (rows,) [s].

    Returns:
        (rows, 3), thrust, load factor, bank angle; 1 where healthy.
    """
    result = np.ones((times.size, len(CHANNELS)))
    for fault in faults:
        result[:, CHANNELS.index(fault.target)] *= 1.0 - (1.0 - fault.effectiveness) * severity(
            fault, times
        )
    return result


def severity(fault: Fault, times: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """How much of the fault is there, 0 to 1, at each time [s]."""
    elapsed = times - fault.start + TIME_TOLERANCE
    present = (elapsed >= 0.0).astype(float)
    if fault.shape == "ramp" and fault.rise is not None:
        present *= np.clip(elapsed / fault.rise, 0.0, 1.0)
    elif fault.shape == "intermittent" and fault.period is not None and fault.duty is not None:
        present *= np.mod(elapsed, fault.period) < fault.duty * fault.period
    if fault.end is not None:
        present *= times < fault.end - TIME_TOLERANCE
    return present


def fault_steps(truth: npt.NDArray[np.float64], scenario: Scenario) -> npt.NDArray[np.int64]:
    """Rows at which an effectiveness jumps: by more than the scenario's steepest ramp would.

    Args:
        truth: (rows,) of one channel.
        scenario: that was flown.
    """
    ramps = [
        (1.0 - fault.effectiveness) / fault.rise / scenario.loop.rate
        for fault in scenario.fault
        if fault.shape == "ramp" and fault.rise is not None
    ]
    steepest = 1.001 * max(ramps, default=0.0) + TIME_TOLERANCE
    return (np.flatnonzero(np.abs(np.diff(truth)) > steepest) + 1).astype(np.int64)
