"""Fault detector: declares a loss of effectiveness from its estimate and standard deviation."""

from typing import Any

import numpy as np

from ftc_jsb.compiled import compiled

DETECTOR = np.dtype(
    [
        ("declared", np.int64),  # 1 while a fault is declared
        ("elapsed", float),  # [s] for which the opposite has held
    ]
)


@compiled
def detect(
    detector: Any,
    estimate: float,
    deviation: float,
    margin: float,
    sigmas: float,
    hold: float,
    dt: float,
) -> float:
    """Advance the detector by one sample and return its statistic.

    The statistic is the loss (1 - estimate) over margin + sigmas x standard deviation. A fault is
    declared when it has exceeded 1 for `hold` seconds without a break, and withdrawn when it has
    been below 1/2 for as long. The margin covers what the variance does not know of: the error of
    the drag and thrust models.
    """
    statistic = (1.0 - estimate) / (margin + sigmas * deviation)
    declared = detector.declared == 1
    opposite = statistic < 0.5 if declared else statistic > 1.0
    detector.elapsed = detector.elapsed + dt if opposite else 0.0
    if detector.elapsed >= hold:
        detector.declared = 0 if declared else 1
        detector.elapsed = 0.0
    return statistic
