"""Health of a filter along one flight: are its innovations as large as it believes?"""

from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

NIS_BOUND = 7.815  # 95 % of chi-squared with three degrees of freedom lie below
SIGMAS = 2.0  # 95 % of a normal variable lie within
MEASURED = ("airspeed", "flight_path_angle", "heading")  # what the NIS is of
ACCELERATION = "acceleration"  # of the accelerometers, where the filter has them


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
        "nis_mean": _mean(nis),
        "nis_inside_fraction": _part(nis <= NIS_BOUND, nis),
    }
    for name in (*MEASURED, ACCELERATION):
        value = np.abs(whitened(record, name))
        found[f"innovation_{name}_inside_fraction"] = _part(value <= SIGMAS, value)
        finite = value[np.isfinite(value)]
        found[f"innovation_{name}_peak_sigmas"] = float(finite.max()) if finite.size else None
    error = record["effectiveness_thrust_est"] - record["effectiveness_thrust"]
    band = SIGMAS * record["effectiveness_thrust_std"]
    inside = _part(np.abs(error) <= band, error)
    found["effectiveness_thrust_inside_fraction"] = found["inside_two_sigma_fraction"] = inside
    return found


def _part(where: npt.NDArray[np.bool_], known: Array) -> float | None:
    told = np.isfinite(known)
    return float(np.mean(where[told])) if told.any() else None


def _mean(values: Array) -> float | None:
    finite = values[np.isfinite(values)]
    return float(finite.mean()) if finite.size else None
