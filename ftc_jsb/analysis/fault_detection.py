"""How soon a fault is declared, and how often without one."""

from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.fault_steps import SETTLING

HEALTHY = 1.0 - 1e-9  # effectiveness below which there is a fault


def detection_metrics(record: npt.NDArray[Any]) -> dict[str, float | None]:
    """Delay [s] of the first declaration after the thrust fault sets in, and the number of false alarms.

    None for both without an estimator; no delay without a fault, or where it is never declared. A
    declaration is a false alarm where the thrust is healthy and was so for SETTLING.
    """
    time, truth = record["time"], record["effectiveness_thrust"]
    declared = record["fault_declared"] > 0.5
    faulty = np.flatnonzero(truth < HEALTHY)
    estimates = bool(np.isfinite(record["effectiveness_thrust_est"]).any())
    onsets = np.flatnonzero(np.diff(declared.astype(int), prepend=0) == 1)
    delay = None
    if faulty.size and estimates:
        after = onsets[onsets >= faulty[0]]
        delay = float(time[after[0]] - time[faulty[0]]) if after.size else None
    # Faulty now, or less than SETTLING ago; a truth that is not known is not healthy
    recently = ~(truth >= HEALTHY)
    for end in np.flatnonzero(np.diff(recently.astype(int)) == -1) + 1:
        recently |= (time >= time[end]) & (time < time[end] + SETTLING)
    return {
        "detection_delay_s": delay,
        "false_alarms": int(np.sum(~recently[onsets])) if estimates else None,
    }
