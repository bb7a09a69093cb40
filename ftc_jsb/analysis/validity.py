"""How well a point mass tells what the 6-DOF aircraft does: differences and Theil's coefficient."""

import math
from typing import Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.tracking import ERROR_NAMES, distance, values_of
from ftc_jsb.recording.flight import Flight
from ftc_jsb.scenario.schema import Agreement
from ftc_jsb.vocabulary.channels import TRACKED
from ftc_jsb.vocabulary.quantities import QUANTITIES, Quantity

Array = npt.NDArray[np.float64]
Answer = Literal["yes", "in part", "no"]

IN_PART = 3.0  # times what is agreed: still worth something
ACCEPTED = 0.3  # Theil's coefficient up to which a model is commonly taken to agree


MOTION = tuple(QUANTITIES[name] for name in (*TRACKED, "thrust_cmd", "load_factor", "bank_angle"))
ERRORS = tuple(QUANTITIES[name] for name in ERROR_NAMES)


class Difference(NamedTuple):
    """Point mass minus 6-DOF of one variable over a flight.

    Theil's inequality coefficient (1966) is RMS(a - b) / (RMS a + RMS b): 0 same, 1 nothing in
    common. The mean square of the difference is made up of three parts that add up to 1: bias (the
    means differ), variance (the fluctuations differ in size) and covariance (they differ in time).
    """

    rms: float
    peak: float
    theil: float
    bias: float
    variance: float
    covariance: float


def compared(variable: Quantity, point_mass: Flight, six_dof: Flight) -> tuple[Array, Array, Array]:
    """Time [s] that both flew, and the variable of both in its unit, where both are known."""
    count = min(point_mass.record.size, six_dof.record.size)
    one, other = (
        variable.shown(values_of(flight.record[:count], variable.name))
        for flight in (point_mass, six_dof)
    )
    known = np.isfinite(one) & np.isfinite(other)
    return point_mass.record["time"][:count][known], one[known], other[known]


def difference(a: Array, b: Array) -> Difference | None:
    """Difference of two series of the same length; None without samples."""
    if a.size == 0:
        return None
    square = float(np.mean((a - b) ** 2))
    size = _rms(a) + _rms(b)
    rms, peak = math.sqrt(square), float(np.abs(a - b).max())
    if square == 0.0:
        return Difference(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    bias = float(np.mean(a) - np.mean(b)) ** 2 / square
    variance = float(np.std(a) - np.std(b)) ** 2 / square
    return Difference(rms, peak, rms / size, bias, variance, 1.0 - bias - variance)


def compare_flights(point_mass: Flight, six_dof: Flight) -> dict[str, Any]:
    """Differences by key of metrics.json, and of the position over the time that both flew."""
    found: dict[str, Any] = {}
    for variable in MOTION + ERRORS:
        _, one, other = compared(variable, point_mass, six_dof)
        result = difference(one, other)
        found[variable.key] = None if result is None else result._asdict()
    distance = apart(point_mass, six_dof)
    found["position_m"] = {"rms": _rms(distance), "peak": float(distance.max())}
    return found


def apart(point_mass: Flight, six_dof: Flight) -> Array:
    """Distance [m] between the two aircraft over the time that both flew."""
    count = min(point_mass.record.size, six_dof.record.size)
    return distance(point_mass.record[:count], six_dof.record[:count])


def judge(pairs: list[dict[str, Any]], agreement: Agreement) -> dict[str, Any]:
    """Whether a point mass told the truth, over its pairs: the answer and the variable that decides.

    "yes": the same verdict in every flight, and no RMS difference beyond what is agreed to be small;
    "in part": the same verdicts, and none beyond IN_PART times that; else "no". Theil's coefficients
    stand beside it.

    Args:
        pairs: entries of `validity` in metrics.json.
        agreement: [compare.agreement] of the scenario.
    """
    motion, errors = (_worst(pairs, group) for group in (MOTION, ERRORS))
    same = all(pair["same_verdict"] for pair in pairs)
    decides = _farthest(pairs, agreement)
    answer: Answer = "no"
    if same and decides["times_agreed"] <= IN_PART:
        answer = "yes" if decides["times_agreed"] <= 1.0 else "in part"
    return {
        "answer": answer,
        "same_verdict": same,
        "decides": decides,
        "motion": motion,
        "tracking_errors": errors,
    }


def _farthest(pairs: list[dict[str, Any]], agreement: Agreement) -> dict[str, Any]:
    """The variable whose RMS difference is the largest multiple of what is agreed to be small."""
    agreed = {
        "airspeed_mps": ("airspeed", "m/s", agreement.airspeed),
        "flight_path_deg": ("flight path", "deg", agreement.flight_path_deg),
        "heading_deg": ("heading", "deg", agreement.heading_deg),
        "position_m": ("position", "m", agreement.position),
    }
    found = [
        {
            "variable": key,
            "title": title,
            "unit": unit,
            "rms": pair["variables"][key]["rms"],
            "agreed": most,
            "times_agreed": pair["variables"][key]["rms"] / most,
        }
        for pair in pairs
        for key, (title, unit, most) in agreed.items()
        if pair["variables"][key] is not None
    ]
    return max(found, key=lambda entry: float(entry["times_agreed"]))


def _worst(pairs: list[dict[str, Any]], group: tuple[Quantity, ...]) -> dict[str, Any]:
    """The largest coefficient of a group of variables, and which variable has it."""
    known = [
        (pair["variables"][variable.key]["theil"], variable)
        for pair in pairs
        for variable in group
        if pair["variables"][variable.key] is not None
    ]
    theil, variable = max(known, key=lambda entry: entry[0])
    return {"theil": theil, "variable": variable.key, "title": variable.title}


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))
