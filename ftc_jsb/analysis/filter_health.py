"""Health of a filter along one flight: are its innovations as large as it believes?"""

from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.finite_statistics import fraction, mean, peak
from ftc_jsb.vocabulary.channels import TRACKED

Array = npt.NDArray[np.float64]

NIS_BOUND = 7.815  # 95 % of chi-squared with three degrees of freedom lie below
SIGMAS = 2.0  # 95 % of a normal variable lie within
INNOVATIONS = (
    *TRACKED,
    "acceleration",
)  # the NIS is of TRACKED; the filter may have no accelerometers


def whitened(record: npt.NDArray[Any], name: str) -> Array:
    """(rows,): innovation of a measured variable over its own standard deviation."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(record[f"{name}_innovation"] / record[f"{name}_innovation_std"])


def estimator_health(record: npt.NDArray[Any]) -> dict[str, float | None]:
    """Parts of the samples inside the 95 % bounds, and how far the worst is outside.

    None where nothing estimates. A consistent filter is inside 95 % of the time; more says that Q
    and R claim too much noise, less that they claim too little or that the model is wrong.
    """
    nis = record["innovation_squared"]
    found = {
        "nis_mean": mean(nis),
        "nis_inside_fraction": fraction(nis <= NIS_BOUND, nis),
    }
    for name in INNOVATIONS:
        value = np.abs(whitened(record, name))
        found[f"innovation_{name}_inside_fraction"] = fraction(value <= SIGMAS, value)
        found[f"innovation_{name}_peak_sigmas"] = peak(value)
    error = record["effectiveness_thrust_est"] - record["effectiveness_thrust"]
    band = SIGMAS * record["effectiveness_thrust_std"]
    inside = fraction(np.abs(error) <= band, error)
    found["effectiveness_thrust_inside_fraction"] = found["inside_two_sigma_fraction"] = inside
    return found
