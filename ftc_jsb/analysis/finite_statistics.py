"""Statistics of the samples that are known: a variable that a flight has not is nan in its recording."""

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]


def mean(values: Array) -> float | None:
    """Mean of the finite samples; None without any."""
    finite = values[np.isfinite(values)]
    return float(finite.mean()) if finite.size else None


def root_mean_square(values: Array) -> float | None:
    """Root mean square of the finite samples; None without any."""
    finite = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(finite**2))) if finite.size else None


def peak(values: Array) -> float | None:
    """Largest size of the finite samples; None without any."""
    finite = values[np.isfinite(values)]
    return float(np.abs(finite).max()) if finite.size else None


def fraction(where: npt.NDArray[np.bool_], known: Array) -> float | None:
    """Part of the samples at which something holds, of those at which it is known at all.

    Args:
        where: (rows,), whether it holds.
        known: (rows,), finite where that is known.
    """
    finite = np.isfinite(known)
    return float(np.mean(where[finite])) if finite.any() else None
