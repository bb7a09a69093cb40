"""Residuals of the drag and thrust models: what the outer loop counts on minus what was flown."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.modelled_drag import modelled_drag
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

    An error of the drag over the thrust is an error of the estimated effectiveness. The thrust
    residual is expected times true effectiveness minus delivered.

    Raises:
        AircraftError: the flight's aircraft is not there any more.
    """
    model = point_mass_of(flight.scenario).record(flight.scenario.aircraft.fuel_fraction)
    record = flight.record
    of_law, of_estimator = modelled_drag(model, record)
    thrust = _expected_thrust(model, record) - record["thrust"]
    return Residuals(of_law - record["drag"], of_estimator - record["drag"], thrust)


def _expected_thrust(model: npt.NDArray[Any], record: npt.NDArray[Any]) -> Array:
    """(rows,): thrust [N] that the faulty engine should have delivered."""
    effectiveness = record["effectiveness_thrust"]
    if model[0]["spool_up"][0] > 0.0:  # what acted until the row
        acted = np.concatenate([effectiveness[:1], effectiveness[:-1]])
        return np.asarray(acted * record["thrust_model"])
    # an engine without a spool answers in the same row
    return np.asarray(effectiveness * record["thrust_cmd"])


def residual_metrics(flight: Flight, residuals: Residuals) -> dict[str, Any]:
    """RMS and peak of each residual in kN, and as an error of the effectiveness (residual / thrust)."""
    found: dict[str, Any] = {}
    thrust = np.abs(flight.record["thrust_model"])
    for name, values in residuals._asdict().items():
        known = np.isfinite(values)
        if not known.any():
            found[f"{name}_kn"] = None
            continue
        kilo = values[known] / 1e3  # kN
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.abs(values / thrust)
        share = share[np.isfinite(share)]
        found[f"{name}_kn"] = {
            "rms": float(np.sqrt(np.mean(kilo**2))),
            "peak": float(np.abs(kilo).max()),
            "as_effectiveness_median": float(np.median(share)) if share.size else None,
        }
    return found
