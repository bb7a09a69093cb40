"""Residuals of the drag and thrust models that a flight's outer loop counts on."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.model_residuals import model_residuals
from ftc_jsb.recording.flight import Flight
from ftc_jsb.simulation.assembly import point_mass_of

Array = npt.NDArray[np.float64]


class Residuals(NamedTuple):
    """Model minus flight [N], (rows,) each; nan where the model or the flight has none."""

    drag_of_law: Array
    drag_of_estimator: Array
    thrust: Array


def flight_residuals(flight: Flight) -> Residuals:
    """Residuals along a flight.

    Raises:
        AircraftError: the flight's aircraft is not there any more.
    """
    model = point_mass_of(flight.scenario).record(flight.scenario.aircraft.fuel_fraction)
    return Residuals(*model_residuals(model, flight.record))


def residual_metrics(flight: Flight, residuals: Residuals) -> dict[str, Any]:
    """RMS and peak of each residual in kN, and as an error of the effectiveness (residual / thrust)."""
    found: dict[str, Any] = {}
    thrust = np.abs(flight.record["thrust_model"])
    for name, values in residuals._asdict().items():
        known = np.isfinite(values)
        if not known.any():
            found[f"{name}_kn"] = None
            continue
        kilo = values[known] / 1e3
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.abs(values / thrust)
        share = share[np.isfinite(share)]
        found[f"{name}_kn"] = {
            "rms": float(np.sqrt(np.mean(kilo**2))),
            "peak": float(np.abs(kilo).max()),
            "as_effectiveness_median": float(np.median(share)) if share.size else None,
        }
    return found
