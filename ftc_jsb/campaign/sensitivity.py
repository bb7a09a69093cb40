"""Which parameters decide: first-order Sobol indices from the cases that were flown, against chance."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import pandas as pd

Array = npt.NDArray[np.float64]
MOST_BINS, CASES_A_BIN = 12, 15
SHUFFLES = 200


class Index(NamedTuple):
    """Part of the variance of a number that one parameter alone explains."""

    parameter: str
    value: float  # 0 to 1
    chance: float  # 95 % quantile of the same without any influence
    bins: int


def first_order(parameters: pd.DataFrame, output: Array, seed: int = 0) -> list[Index]:
    """Indices of every parameter, the largest first; those that do not vary are left out.

    The variance of the means over bins of a parameter over the whole (Plischke et al. 2013), less the part
    that chance has in it (Kelley's epsilon squared); `chance` is of shuffled outputs.

    Args:
        parameters: a column each, numbers or texts; missing where one does not apply.
        output: (cases,), finite.
        seed: of the shuffles.
    """
    random = np.random.default_rng(seed)
    found = []
    for name in parameters.columns:
        groups = grouped(parameters[name])
        count = int(groups.max(initial=0)) + 1
        if count < 2 or output.size <= count or np.ptp(output) == 0.0:
            continue
        value = _explained(groups, count, output)
        shuffled = [_explained(groups, count, random.permutation(output)) for _ in range(SHUFFLES)]
        found.append(Index(str(name), max(value, 0.0), float(np.quantile(shuffled, 0.95)), count))
    return sorted(found, key=lambda index: -index.value)


def grouped(values: "pd.Series[Any]") -> npt.NDArray[np.int64]:
    """(cases,): bin of each value, equally filled, or one for each text; the last is of what is missing."""
    if not pd.api.types.is_numeric_dtype(values) or values.nunique() <= MOST_BINS:
        codes, names = pd.factorize(values, sort=True)
        return np.where(codes < 0, len(names), codes)
    bins = max(2, min(MOST_BINS, int(values.count()) // CASES_A_BIN))
    codes = pd.qcut(values.rank(method="first"), bins, labels=False)
    return np.asarray(codes.fillna(bins), dtype=np.int64)


def _explained(groups: npt.NDArray[np.int64], count: int, output: Array) -> float:
    sizes = np.bincount(groups, minlength=count)
    used = sizes > 0
    means = np.bincount(groups, output, minlength=count)[used] / sizes[used]
    between = float(np.sum(sizes[used] * (means - output.mean()) ** 2))
    total = float(np.sum((output - output.mean()) ** 2))
    bins = int(used.sum())
    within = (total - between) / (output.size - bins)
    return (between - (bins - 1) * within) / total
