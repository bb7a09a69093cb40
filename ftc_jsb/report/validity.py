"""How well a point mass tells what the 6-DOF aircraft does: differences and Theil's coefficient."""

from typing import NamedTuple

import numpy as np

from ftc_jsb.simulation.flight import Flight

# variable, title, unit, factor from SI
COMPARED = (
    ("airspeed", "Airspeed", "m/s", 1.0),
    ("flight_path_angle", "Flight path", "deg", 180.0 / np.pi),
    ("heading", "Heading", "deg", 180.0 / np.pi),
    ("thrust_cmd", "Thrust command", "kN", 1e-3),
    ("load_factor", "Load factor", "", 1.0),
    ("bank_angle", "Bank angle", "deg", 180.0 / np.pi),
)


class Difference(NamedTuple):
    """Point mass minus 6-DOF of one variable over a flight."""

    title: str
    unit: str
    rms: float
    peak: float
    theil: float  # Theil's inequality coefficient (1966): 0 same, 1 nothing in common


def compare_flights(point_mass: Flight, six_dof: Flight) -> list[Difference]:
    """Differences over the time that both flew, and of the position at its end."""
    count = min(point_mass.record.size, six_dof.record.size)
    one, other = point_mass.record[:count], six_dof.record[:count]
    rows = []
    for name, title, unit, factor in COMPARED:
        a, b = factor * one[name], factor * other[name]
        use = np.isfinite(a) & np.isfinite(b)
        rows.append(_difference(title, unit, a[use], b[use]))
    square = sum((one[axis] - other[axis]) ** 2 for axis in ("north", "east", "altitude"))
    distance = np.sqrt(square)
    rows.append(Difference("Position", "m", _rms(distance), float(distance.max()), float("nan")))
    return rows


def _difference(title: str, unit: str, a: np.ndarray, b: np.ndarray) -> Difference:
    size = _rms(a) + _rms(b)
    rms = _rms(a - b)
    return Difference(
        title, unit, rms, float(np.abs(a - b).max()), rms / size if size > 0.0 else 0.0
    )


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))
