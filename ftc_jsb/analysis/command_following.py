"""How the aircraft with its inner loop follows the commands: what was commanded against what was flown."""

from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.recording.flight import Flight
from ftc_jsb.vocabulary.channels import CHANNELS
from ftc_jsb.vocabulary.quantities import QUANTITIES, Quantity

Array = npt.NDArray[np.float64]
LONGEST_DELAY = 2.0  # [s] that is searched for


AXES = tuple(QUANTITIES[channel] for channel in CHANNELS)  # each commanded and achieved


def commanded_and_achieved(flight: Flight, axis: Quantity) -> tuple[Array, Array]:
    """(rows,) each, in the axis' unit: command times true effectiveness, and what came of it.

    A command acts from its own row to the next, so that the row after shows what it did; but an aircraft
    that answers at once (the paper's) has achieved it in the same row.
    """
    record = flight.record
    command = record[f"{axis.name}_cmd"] * record[f"effectiveness_{axis.name}"]
    achieved = record[axis.name]
    if not np.array_equal(command, achieved, equal_nan=True):
        command = np.concatenate([command[:1], command[:-1]])
    return axis.shown(command), axis.shown(achieved)


def command_following_metrics(flight: Flight) -> dict[str, Any]:
    """For each axis RMS and peak of achieved minus command, and the delay that explains most of it.

    The delay is the shift of the command, in whole samples, at which the RMS is least; None where the
    command never moves.
    """
    found: dict[str, Any] = {}
    for axis in AXES:
        command, achieved = commanded_and_achieved(flight, axis)
        error = (achieved - command)[np.isfinite(achieved - command)]
        found[axis.key] = {
            "rms": float(np.sqrt(np.mean(error**2))) if error.size else None,
            "peak": float(np.abs(error).max()) if error.size else None,
            "delay_s": _delay(command, achieved, 1.0 / flight.row_period),
        }
    return found


def _delay(command: Array, achieved: Array, rate: float) -> float | None:
    known = np.isfinite(command) & np.isfinite(achieved)
    command, achieved = command[known], achieved[known]
    most = min(round(LONGEST_DELAY * rate), command.size // 2)
    if most < 1 or np.ptp(command) == 0.0:
        return None
    kept = achieved[most:]  # the same samples for every shift
    squares = [
        np.mean((kept - command[most - shift : command.size - shift]) ** 2)
        for shift in range(most + 1)
    ]
    return float(np.argmin(squares)) / rate
