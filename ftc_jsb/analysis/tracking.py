"""How well a flight follows its references: errors, and the distance from the path that they make."""

from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.finite_statistics import peak, root_mean_square
from ftc_jsb.vocabulary.channels import TRACKED
from ftc_jsb.vocabulary.quantities import QUANTITIES

Array = npt.NDArray[np.float64]
ERROR_NAMES = (
    "error_airspeed",
    "error_flight_path_deg",
    "error_heading_deg",
)  # of TRACKED; keys of [limits]


def tracking_errors(record: npt.NDArray[Any]) -> dict[str, Array]:
    """True value minus reference by ERROR_NAMES: airspeed [m/s], flight path and heading [deg]."""
    return {
        error: QUANTITIES[name].shown(record[name] - record[f"{name}_ref"])
        for error, name in zip(ERROR_NAMES, TRACKED, strict=True)
    }


def values_of(record: npt.NDArray[Any], name: str) -> Array:
    """(rows,): a column of the recording, or one of ERROR_NAMES."""
    return tracking_errors(record)[name] if name in ERROR_NAMES else record[name]


def distance(record: npt.NDArray[Any], other: npt.NDArray[Any], suffix: str = "") -> Array:
    """(rows,): distance [m] from another recording's place, or with `_ref` from its reference path."""
    square = sum(
        (record[axis] - other[f"{axis}{suffix}"]) ** 2 for axis in ("north", "east", "altitude")
    )
    return np.asarray(np.sqrt(square))


def position_errors(record: npt.NDArray[Any]) -> dict[str, Array]:
    """Place minus that on the reference path [m]: ahead of it, right of it, above it."""
    north, east = (record[axis] - record[f"{axis}_ref"] for axis in ("north", "east"))
    cosine, sine = np.cos(record["heading_ref"]), np.sin(record["heading_ref"])
    return {
        "error_along": cosine * north + sine * east,
        "error_across": cosine * east - sine * north,
        "error_height": record["altitude"] - record["altitude_ref"],
    }


def tracking_metrics(record: npt.NDArray[Any]) -> dict[str, Any]:
    """RMS and peak of each tracking error and of the position; units are in the keys."""
    errors = {
        QUANTITIES[name].key: values
        for name, values in zip(TRACKED, tracking_errors(record).values(), strict=True)
    }
    off = distance(record, record, "_ref")
    return {
        **{f"rmse_{key}": root_mean_square(values) for key, values in errors.items()},
        **{f"peak_error_{key}": peak(values) for key, values in errors.items()},
        "rmse_position_m": root_mean_square(off),
        "peak_error_position_m": peak(off),
    }
