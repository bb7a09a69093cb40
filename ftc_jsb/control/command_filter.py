"""Command filter F = w^2 / (s^2 + 2 z w s + w^2) of section 5, sampled without error.

It turns the raw commands (44) into references y_m with a derivative that exists everywhere.
"""

from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled
from ftc_jsb.control.path import acceleration
from ftc_jsb.point_mass.dynamics import velocity
from ftc_jsb.vocabulary.kernel_types import Records

COMMAND_FILTER = np.dtype(
    [
        ("transition", float, (2, 2)),
        ("from_now", float, (2,)),  # effect of the raw command at the start of a sample
        ("from_next", float, (2,)),  # and at its end
        ("value", float, (3,)),  # airspeed, flight path angle, heading
        ("slope", float, (3,)),
        ("position", float, (3,)),  # north, east, altitude [m] of the path that they make
        ("velocity", float, (3,)),  # on it [m/s]
        ("acceleration", float, (3,)),  # [m/s^2]
    ]
)


def command_filter(
    frequency: float,
    damping: float,
    dt: float,
    initial: npt.ArrayLike,
    position: npt.ArrayLike = (0.0, 0.0, 0.0),
) -> npt.NDArray[Any]:
    """A COMMAND_FILTER array of one record, at rest on `initial`.

    The input is taken as linear over a sample, which (44) is between its breakpoints; the step is
    then the exact solution of F (first-order hold, Van Loan 1978).

    Args:
        frequency: w [rad/s].
        damping: z [-].
        dt: sample time [s].
        initial: (3,), raw commands at the start.
        position: (3,), north, east and altitude [m] at the start.
    """
    augmented = np.zeros((4, 4))
    augmented[:2, :2] = [[0.0, 1.0], [-(frequency**2), -2.0 * damping * frequency]]
    augmented[1, 2] = frequency**2
    augmented[2, 3] = 1.0 / dt  # the input rises linearly from now to next
    step = _exponential(augmented * dt)
    filters = np.zeros(1, COMMAND_FILTER)
    filters["transition"][0] = step[:2, :2]
    filters["from_next"][0] = step[:2, 3]
    filters["from_now"][0] = step[:2, 2] - step[:2, 3]
    filters["value"][0] = initial
    filters["position"][0] = position
    filters["velocity"][0] = velocity(*filters["value"][0])  # at rest: no acceleration
    return filters


def _exponential(matrix: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Exp of a small matrix by scaling, Taylor's series and squaring.

    `scipy.linalg.expm` is the same to rounding (tested), but its import takes longer than a flight.
    """
    norm = float(np.abs(matrix).sum(axis=1).max())
    halvings = max(0, int(np.ceil(np.log2(max(norm, 1e-300)))))
    small = matrix / 2.0**halvings
    total = term = np.eye(len(matrix))
    for order in range(1, 21):  # the norm is at most 1: 20 terms leave 1 / 21! = 2e-20
        term = term @ small / order
        total = total + term
    for _ in range(halvings):
        total = total @ total
    return total


@compiled
def reference_step(filters: Any, record: Records, i: int) -> None:
    """Write the references of row `i` and advance the filter to row `i + 1`.

    Args:
        filters: (1,) COMMAND_FILTER.
        record: (rows,) of the recording; the raw commands of rows i and i + 1 are read.
        i: row.
    """
    f = filters[0]
    row = record[i]
    row.airspeed_ref = f.value[0]
    row.flight_path_angle_ref = f.value[1]
    row.heading_ref = f.value[2]
    row.airspeed_ref_rate = f.slope[0]
    row.flight_path_angle_ref_rate = f.slope[1]
    row.heading_ref_rate = f.slope[2]
    row.north_ref, row.east_ref, row.altitude_ref = f.position[0], f.position[1], f.position[2]
    if i + 1 == record.size:
        return
    after = record[i + 1]
    now = (row.airspeed_cmd_raw, row.flight_path_angle_cmd_raw, row.heading_cmd_raw)
    following = (after.airspeed_cmd_raw, after.flight_path_angle_cmd_raw, after.heading_cmd_raw)
    for k in range(3):
        _advance(f, k, now[k], following[k])
    _travel(f, after.time - row.time)


@compiled
def _travel(f: Any, dt: float) -> None:
    """The path of the references: (42) integrated with them, by Hermite's rule (order 4)."""
    value, slope = (f.value[0], f.value[1], f.value[2]), (f.slope[0], f.slope[1], f.slope[2])
    v, a = velocity(*value), acceleration(*value, *slope)
    for k in range(3):
        f.position[k] += 0.5 * dt * (f.velocity[k] + v[k])
        f.position[k] += dt * dt / 12.0 * (f.acceleration[k] - a[k])
        f.velocity[k], f.acceleration[k] = v[k], a[k]


@compiled
def _advance(f: Any, k: int, now: float, after: float) -> None:
    value, slope = f.value[k], f.slope[k]
    f.value[k] = (
        f.transition[0, 0] * value
        + f.transition[0, 1] * slope
        + f.from_now[0] * now
        + f.from_next[0] * after
    )
    f.slope[k] = (
        f.transition[1, 0] * value
        + f.transition[1, 1] * slope
        + f.from_now[1] * now
        + f.from_next[1] * after
    )
