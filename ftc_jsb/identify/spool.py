"""Fit of the rates at which the engine spools up and down."""

from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.aircraft.dynamic_pressure import density_at
from ftc_jsb.errors import AircraftError
from ftc_jsb.identify.regression import Array
from ftc_jsb.identify.thrust_deck import Deck

SEA_LEVEL_DENSITY = 1.225  # [kg/m^3]
FEWEST = 20  # samples that a fit needs


def fit_spool(records: list[npt.NDArray[Any]], deck: Deck) -> tuple[Array, Array]:
    """Coefficients c0..c2 of `thrust.spool_rate`, accelerating and decelerating.

    The rotor speed is not read: it is what the dry thrust tells, N = sqrt((T - idle) / (mil - idle)),
    at throttles up to 1. Rates count where N is still far from where the throttle sends it.

    Args:
        records: test flights.
        deck: as fitted to them.

    Raises:
        AircraftError: the flights hold no throttle steps.
    """
    fitted = [_fit_rate(_spooling(records, deck, accelerating)) for accelerating in (True, False)]
    return fitted[0], fitted[1]


def _spooling(records: list[npt.NDArray[Any]], deck: Deck, accelerating: bool) -> Array:
    """(samples, 3): rotor speed, size of its rate [1/s], density [kg/m^3], where the spool limits it."""
    found = []
    for record in records:
        idle, military, _ = deck.levels(record)
        square = (record["thrust"] - idle) / (military - idle)
        target = np.clip(record["throttle"], 0.0, 1.0)
        speed = np.sqrt(np.clip(square, 0.0, 1.0))
        rate = np.gradient(speed, record["time"])
        density = density_at(record["altitude"])
        dry = (record["throttle"] < 1.0) & (square > 0.01)
        gap = target - speed if accelerating else speed - target
        use = dry & (gap > 0.1) & ((rate > 0.02) == accelerating) & (np.abs(rate) > 0.02)
        found.append(np.stack([speed[use], np.abs(rate[use]), density[use]], axis=1))
    return np.concatenate(found)


def _fit_rate(data: Array) -> Array:
    """(3,) coefficients c0..c2 of one direction."""
    from scipy.optimize import least_squares

    if len(data) < FEWEST:
        raise AircraftError("identification: the test flights hold no throttle steps")
    lag = (1.0 - np.minimum(1.0, data[:, 0] + 0.1)) ** 3
    thin = 1.0 - data[:, 2] / SEA_LEVEL_DENSITY

    def residual(c: Array) -> Array:
        return np.asarray(c[0] / (1.0 + c[1] * lag + c[2] * thin) - data[:, 1])

    result = least_squares(
        residual, [1.0, 1.0, 0.5], bounds=([0.01, 0.0, 0.0], [100.0, 50.0, 10.0]), loss="soft_l1",
        f_scale=0.1,
    )  # fmt: skip
    return np.asarray(result.x)
