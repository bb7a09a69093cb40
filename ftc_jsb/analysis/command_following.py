"""The achieved inner-loop response: what was commanded against what was flown."""

import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.recording.flight import Flight

Array = npt.NDArray[np.float64]
LONGEST_DELAY = 2.0  # [s] that is searched for


class Axis(NamedTuple):
    """A command and its answer."""

    name: str  # in the recording
    key: str  # in metrics.json
    title: str
    unit: str
    factor: float


AXES = (
    Axis("thrust", "thrust_kn", "Thrust", "kN", 1e-3),
    Axis("load_factor", "load_factor", "Load factor", "", 1.0),
    Axis("bank_angle", "bank_deg", "Bank", "deg", math.degrees(1.0)),
)


def command_and_answer(flight: Flight, axis: Axis) -> tuple[Array, Array]:
    """(rows,) each, in the axis' unit: command times true effectiveness, and what came of it.

    A command acts from its own row to the next, so that the row after shows what it did; but an aircraft
    that answers at once (the paper's) has the answer in the same row.
    """
    record = flight.record
    command = record[f"{axis.name}_cmd"] * record[f"effectiveness_{axis.name}"]
    answer = record[axis.name]
    if not np.array_equal(command, answer, equal_nan=True):
        command = np.concatenate([command[:1], command[:-1]])
    return axis.factor * command, axis.factor * answer


def response_metrics(flight: Flight) -> dict[str, Any]:
    """For each axis RMS and peak of answer minus command, and the delay that explains most of it.

    The delay is the shift of the command, in whole samples, at which the RMS is least; None where the
    command never moves.
    """
    found: dict[str, Any] = {}
    for axis in AXES:
        command, answer = command_and_answer(flight, axis)
        error = (answer - command)[np.isfinite(answer - command)]
        found[axis.key] = {
            "rms": float(np.sqrt(np.mean(error**2))) if error.size else None,
            "peak": float(np.abs(error).max()) if error.size else None,
            "delay_s": _delay(command, answer, 1.0 / flight.row_period),
        }
    return found


def _delay(command: Array, answer: Array, rate: float) -> float | None:
    known = np.isfinite(command) & np.isfinite(answer)
    command, answer = command[known], answer[known]
    most = min(round(LONGEST_DELAY * rate), command.size // 2)
    if most < 1 or np.ptp(command) == 0.0:
        return None
    kept = answer[most:]  # the same samples for every shift
    squares = [
        np.mean((kept - command[most - shift : command.size - shift]) ** 2)
        for shift in range(most + 1)
    ]
    return float(np.argmin(squares)) / rate
