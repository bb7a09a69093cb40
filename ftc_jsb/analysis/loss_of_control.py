"""Loss of control: when it begins, and as what."""

import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

INVERTED = math.radians(95.0)  # [rad] of bank: no reference asks for it
INVERTED_TIME = 0.3  # [s] without a break
STALLED = (math.radians(-20.0), math.radians(35.0))  # [rad], angle of attack
SLIPPED = math.radians(20.0)  # [rad], sideslip
RATES = (4.5, 2.0, 1.5)  # [rad/s] of roll, pitch and yaw: beyond what the inner loops ask for
DEPARTED_TIME = 0.2  # [s] without a break
DIVERGING = (  # variable, its title, error beyond which it is lost when it grows
    ("airspeed", "airspeed", 0.3),  # of the reference
    ("flight_path_angle", "flight path", math.radians(30.0)),  # [rad]
    ("heading", "heading", math.radians(90.0)),  # [rad]
)
GIVEN_UP = {"airspeed": "airspeed_given_up", "flight_path_angle": "climb_given_up"}  # on purpose
HELD_PATH = math.radians(3.0)  # [rad]: a path error up to which a dive is flown as it was asked for
AWAY = 5.0  # [s] over which the aircraft has gone away from its reference


class LossOfControl(NamedTuple):
    """When control was lost [s], and as what."""

    time: float
    kind: str


def loss_of_control(record: npt.NDArray[Any]) -> LossOfControl | None:
    """The first loss of control of a flight; None where there is none.

    Inverted: bank beyond 95 deg for 0.3 s. Departed: angle of attack, sideslip or body rates
    beyond what an airframe is flown at. Diverging: far from the reference and going away from it for 5 s.
    """
    if record.size < 2:
        return None
    period = float(record["time"][1] - record["time"][0])
    alpha, sideslip = record["alpha"], record["sideslip"]
    rates = [record[f"{axis}_rate"] for axis in ("roll", "pitch", "yaw")]
    fast = np.any([np.abs(rate) > most for rate, most in zip(rates, RATES, strict=True)], axis=0)
    kinds = {
        "inverted": (inverted(record), INVERTED_TIME),
        "angle of attack": ((alpha < STALLED[0]) | (alpha > STALLED[1]), DEPARTED_TIME),
        "sideslip": (np.abs(sideslip) > SLIPPED, DEPARTED_TIME),
        "body rates": (fast, DEPARTED_TIME),
        **{
            f"{title} diverges": (_diverging(record, name, most, period), 0.0)
            for name, title, most in DIVERGING
        },
    }
    found = [
        LossOfControl(float(record["time"][first]), kind)
        for kind, (where, seconds) in kinds.items()
        if (first := _first_lasting(where, round(seconds / period))) is not None
    ]
    return min(found, default=None)


def inverted(record: npt.NDArray[Any]) -> Mask:
    """(rows,): samples on the back."""
    bank = record["bank_angle"]
    return np.asarray(np.abs(np.arctan2(np.sin(bank), np.cos(bank))) > INVERTED)


def _diverging(record: npt.NDArray[Any], name: str, most: float, period: float) -> Mask:
    """Where a variable is far from its reference, and has gone away from it for the last seconds.

    A reference that goes away from the aircraft is none of the aircraft's doing.
    """
    value, error = record[name], record[name] - record[f"{name}_ref"]
    if name in GIVEN_UP:
        error = error + np.nan_to_num(record[GIVEN_UP[name]])
    if name == "airspeed":
        error = error / np.maximum(record["airspeed_ref"], 1.0)
        error[_fast_at_idle(record)] = 0.0
    steps = max(round(AWAY / period), 1)
    result = np.zeros(record.size, dtype=bool)
    if record.size > steps:
        away = (value[steps:] - value[:-steps]) * error[steps:] > 0.0
        result[steps:] = away & (np.abs(error[steps:]) > most)
    return result


def _fast_at_idle(record: npt.NDArray[Any]) -> Mask:
    """Where idle thrust cannot hold the airspeed of the dive that was asked for: too fast, in control."""
    dive = np.abs(record["flight_path_angle"] - record["flight_path_angle_ref"]) < HELD_PATH
    fast = record["airspeed"] > record["airspeed_ref"]
    idle = (record["thrust_saturated"] > 0.5) & (record["thrust_cmd"] < record["drag"])
    return np.asarray(idle & dive & fast)


def _first_lasting(where: Mask, rows: int) -> int | None:
    """First row of the first stretch of at least `rows` rows at which something holds."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], where.astype(np.int8), [0]])))
    for start, end in zip(edges[::2], edges[1::2], strict=True):
        if end - start >= max(rows, 1):
            return int(start)
    return None
