"""The consistency scenario: gentle turns from side to side with the filter's own noise."""

import numpy as np

from ftc_jsb.aircraft.point_mass_file import load_point_mass
from ftc_jsb.analysis.consistency import Case, Consistency, consistency
from ftc_jsb.resources import aircraft_folder

DT = 0.01  # [s]
MEASUREMENT = np.array([1e-2, 1e-6, 1e-6])  # (0.1 m/s)^2, (1 mrad)^2


def manoeuvre(samples: int) -> np.ndarray:
    """Thrust [N], load factor and bank [rad] that are all excited."""
    t = DT * np.arange(samples)
    bank = 0.9 * np.sin(0.5 * t)
    return np.column_stack([60e3 + 10e3 * np.sin(0.7 * t), 1.0 / np.cos(bank), bank])


def noisy_flights(
    channels: int, flights: int = 200, samples: int = 1000, believed: float = 1.0
) -> Consistency:
    """Flights with 1 or 3 estimated channels; `believed` scales the R that the filter counts on."""
    model = load_point_mass(aircraft_folder("paper")).record(0.0)
    process = np.concatenate([[1e-4, 1e-8, 1e-8], np.full(channels, 1e-8)])
    initial = np.concatenate([[300.0, 0.0, 0.0], np.ones(channels)])
    spread = np.concatenate([MEASUREMENT, np.full(channels, 1e-2)])
    case = Case(
        model, manoeuvre(samples), initial, 3048.0, DT, process, MEASUREMENT, spread
    )  # altitude [m]
    return consistency(case, flights, 7, believed)
