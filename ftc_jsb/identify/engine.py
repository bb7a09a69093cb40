"""Fit of the thrust deck over throttle, Mach and altitude, and of the spool's rates."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.errors import AircraftError
from ftc_jsb.identify.regression import Array, hats, product, rough, solve
from ftc_jsb.point_mass.atmosphere import standard_atmosphere

MACH_STEP = 0.1
ALTITUDE_STEP = 3048.0  # [m]: 10 000 ft, as engine decks are published
SETTLED = 150  # samples for which the throttle must have stood nearly still


class Deck(NamedTuple):
    """Healthy thrust [N] at idle, military and full reheat over (Mach, altitude)."""

    mach: Array
    altitude: Array
    idle: Array
    military: Array
    maximum: Array

    def levels(self, rows: npt.NDArray[Any]) -> tuple[Array, Array, Array]:
        """Idle, military and maximum thrust [N] at the Mach and altitude of recorded rows."""
        at = product(hats(rows["mach"], self.mach), hats(rows["altitude"], self.altitude))
        return at @ self.idle.ravel(), at @ self.military.ravel(), at @ self.maximum.ravel()


def fit_deck(records: list[npt.NDArray[Any]]) -> Deck:
    """Deck from samples whose throttle stands nearly still.

    Dry thrust is idle (1 - N^2) + military N^2 with N the throttle up to 1; reheat, the throttle
    above 1, goes from there to maximum, which is military thrust where it never does.

    Raises:
        AircraftError: the flights hold no settled thrust.
    """
    rows = np.concatenate([record[_settled(record)][::5] for record in records])
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
    at = product(hats(rows["mach"], mach), hats(rows["altitude"], altitude))
    design = np.hstack(
        [
            at * ((1.0 - reheat) * (1.0 - dry))[:, None],
            at * ((1.0 - reheat) * dry)[:, None],
            at * reheat[:, None],
        ]
    )
    m, n = len(mach), len(altitude)
    smooth = np.kron(np.eye(3), np.vstack([rough(m, n), np.kron(np.eye(m), rough(n, 1))]))
    scale = 1.0 / np.abs(rows["thrust"]).mean()
    weight = np.full(len(rows), scale)
    solution = solve(design, rows["thrust"], weight, [1e-5 * scale * smooth])
    idle, military, maximum = solution.reshape(3, m, n)
    if not reheat.any():
        maximum = military
    return Deck(mach, altitude, idle, military, maximum)


def _settled(record: npt.NDArray[Any]) -> npt.NDArray[np.bool_]:
    """Samples before which the throttle has moved by less than 0.02 in each tenth of a second."""
    moving = np.abs(np.diff(record["throttle"], prepend=record["throttle"][0])) > 0.002
    since = np.arange(record.size) - np.maximum.accumulate(
        np.where(moving, np.arange(record.size), 0)
    )
    return np.asarray(since > SETTLED)


def fit_spool(records: list[npt.NDArray[Any]], deck: Deck) -> tuple[Array, Array]:
    """Coefficients c0..c2 of `thrust.spool_rate`, accelerating and decelerating.

    The rotor speed is not read: it is what the dry thrust tells, N = sqrt((T - idle) / (mil - idle)),
    at throttles up to 1. Rates count where N is still far from where the throttle sends it.
    """
    from scipy.optimize import least_squares

    speeds: dict[bool, list[Array]] = {True: [], False: []}
    for record in records:
        idle, military, _ = deck.levels(record)
        square = (record["thrust"] - idle) / (military - idle)
        target = np.clip(record["throttle"], 0.0, 1.0)
        speed = np.sqrt(np.clip(square, 0.0, 1.0))
        rate = np.gradient(speed, record["time"])
        density = np.array([standard_atmosphere(h)[0] for h in record["altitude"]])
        dry = (record["throttle"] < 1.0) & (square > 0.01)
        for accelerating in (True, False):
            gap = target - speed if accelerating else speed - target
            use = dry & (gap > 0.1) & ((rate > 0.02) == accelerating) & (np.abs(rate) > 0.02)
            speeds[accelerating].append(
                np.stack([speed[use], np.abs(rate[use]), density[use]], axis=1)
            )
    fitted = []
    for accelerating in (True, False):
        data = np.concatenate(speeds[accelerating])
        if len(data) < 20:
            raise AircraftError("identification: the test flights hold no throttle steps")
        lag = (1.0 - np.minimum(1.0, data[:, 0] + 0.1)) ** 3
        thin = 1.0 - data[:, 2] / 1.225

        def residual(c: Array, lag: Array = lag, thin: Array = thin, data: Array = data) -> Array:
            return np.asarray(c[0] / (1.0 + c[1] * lag + c[2] * thin) - data[:, 1])

        result = least_squares(
            residual, [1.0, 1.0, 0.5], bounds=([0.01, 0.0, 0.0], [100.0, 50.0, 10.0]), loss="soft_l1",
            f_scale=0.1,
        )  # fmt: skip
        fitted.append(np.asarray(result.x))
    return fitted[0], fitted[1]
