"""Fit of the thrust deck over throttle, Mach and altitude."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.aircraft.dynamic_pressure import density_at
from ftc_jsb.errors import AircraftError
from ftc_jsb.identify.regression import Array, hats, products, second_differences, solve

MACH_STEP = 0.1
ALTITUDE_STEP = 3048.0  # [m]: 10 000 ft, as engine decks are published
# Where no flight has settled, thrust over density goes on as at the neighbours: straight, else level.
STRAIGHT, LEVEL = 1e-4, 1e-5  # of mean thrust: weights of second and first differences
SEA_LEVEL_DENSITY = 1.225  # [kg/m^3]
SETTLED = 150  # samples for which the throttle must have stood nearly still
STILL = 50  # samples over which the rotor speed, as thrust tells it, may change by
STILL_SPEED = 0.005  # of the largest of the flight


class Deck(NamedTuple):
    """Healthy thrust [N] at idle, military and full reheat over (Mach, altitude)."""

    mach: Array
    altitude: Array
    idle: Array
    military: Array
    maximum: Array

    def levels(self, rows: npt.NDArray[Any]) -> tuple[Array, Array, Array]:
        """Idle, military and maximum thrust [N] at the Mach and altitude of recorded rows."""
        at = products(hats(rows["mach"], self.mach), hats(rows["altitude"], self.altitude))
        return at @ self.idle.ravel(), at @ self.military.ravel(), at @ self.maximum.ravel()


def fit_deck(records: list[npt.NDArray[Any]]) -> Deck:
    """Deck from samples whose throttle stands nearly still.

    Dry thrust is idle (1 - N^2) + military N^2 with N the throttle up to 1; reheat, the throttle
    above 1, goes from there to maximum, which is military thrust where it never does.

    Raises:
        AircraftError: the flights hold no settled thrust.
    """
    rows = np.concatenate([record[settled(record)][::5] for record in records])
    if len(rows) < 100:
        raise AircraftError("identification: the test flights hold no settled thrust")
    mach = np.arange(
        np.floor(rows["mach"].min() / MACH_STEP), np.ceil(rows["mach"].max() / MACH_STEP) + 1
    )
    mach = mach * MACH_STEP
    highest = np.ceil(rows["altitude"].max() / ALTITUDE_STEP)
    altitude = np.arange(highest + 1) * ALTITUDE_STEP
    dry = np.clip(rows["throttle"], 0.0, 1.0) ** 2
    reheat = np.clip(rows["throttle"] - 1.0, 0.0, 1.0)
    at = products(hats(rows["mach"], mach), hats(rows["altitude"], altitude))
    design = np.hstack(
        [
            at * ((1.0 - reheat) * (1.0 - dry))[:, None],
            at * ((1.0 - reheat) * dry)[:, None],
            at * reheat[:, None],
        ]
    )
    m, n = len(mach), len(altitude)
    curved = np.vstack([second_differences(m, n), np.kron(np.eye(m), second_differences(n, 1))])
    sloped = np.vstack(
        [
            np.kron(np.diff(np.eye(m), axis=0), np.eye(n)),
            np.kron(np.eye(m), np.diff(np.eye(n), axis=0)),
        ]
    )
    smooth = np.kron(np.eye(3), np.vstack([STRAIGHT * curved, LEVEL * sloped]))
    scale = 1.0 / np.abs(rows["thrust"]).mean()
    weight = np.full(len(rows), scale)
    thinner = np.tile(density_at(altitude) / SEA_LEVEL_DENSITY, 3 * m)
    solution = solve(design * thinner, rows["thrust"], weight, [scale * smooth]) * thinner
    idle, military, maximum = solution.reshape(3, m, n)
    if not reheat.any():
        maximum = military
    return Deck(mach, altitude, idle, military, maximum)


def settled(record: npt.NDArray[Any]) -> npt.NDArray[np.bool_]:
    """Samples before which the throttle has moved by less than 0.02 in each tenth of a second.

    And to which the thrust no longer goes: a large fan takes its time to spool.
    """
    moving = np.abs(np.diff(record["throttle"], prepend=record["throttle"][0])) > 0.002
    since = np.arange(record.size) - np.maximum.accumulate(
        np.where(moving, np.arange(record.size), 0)
    )
    speed = np.sqrt(np.maximum(record["thrust"], 0.0))  # as the rotor's, over the root of a thrust
    change = np.full(record.size, np.inf)
    change[STILL:] = np.abs(speed[STILL:] - speed[:-STILL])
    return np.asarray((since > SETTLED) & (change < STILL_SPEED * speed.max()))
