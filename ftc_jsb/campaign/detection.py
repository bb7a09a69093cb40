"""What the detector's statistic rose to, healthy and faulty: where a threshold would have been passed."""

from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.fault_detection import HEALTHY
from ftc_jsb.analysis.fault_steps import SETTLING


def peak_statistics(record: npt.NDArray[Any]) -> dict[str, float | None]:
    """The largest detector statistic before a thrust fault, and from it on; None without such samples.

    The first SETTLING [s] are left out: the filter starts.
    """
    statistic = record["fault_statistic"]
    faulty = record["effectiveness_thrust"] < HEALTHY
    known = np.isfinite(statistic) & (record["time"] >= SETTLING)
    after = np.logical_or.accumulate(faulty)
    return {
        "statistic_peak_healthy": _largest(statistic[known & ~after]),
        "statistic_peak_faulty": _largest(statistic[known & faulty]),
    }


def _largest(values: npt.NDArray[np.float64]) -> float | None:
    return float(values.max()) if values.size else None
