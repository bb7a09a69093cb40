"""What happens between two samples of a plant, in one compiled call, and whole stretches of point-mass flight.

`fly` takes a sample of any plant with `perceive` and `sample_step`; a point mass flies on without
Python. The kernels are the same and in the same order, so the flight is the same to the bit (a test
compares).
"""

from typing import Any

from ftc_jsb.compiled import compiled
from ftc_jsb.control.command_filter import reference_step
from ftc_jsb.control.outer_loop import outer_loop_step
from ftc_jsb.disturbance.sensors import measure
from ftc_jsb.point_mass.motion import point_mass_step, point_mass_truth
from ftc_jsb.simulation.departure import FLYING, departed


@compiled
def perceive(sensors: Any, faults: Any, filters: Any, record: Any, table: Any, i: int) -> int:
    """From the truth in row `i`: what is measured, what is to be tracked, and whether it still flies.

    Args:
        sensors, faults, table: as `measure` takes them.
        filters: as `reference_step` takes them.
        record: (rows,) of the recording.
        i: row.

    Returns:
        Why the flight has departed; FLYING if it has not.
    """
    measure(sensors, faults, record, table, i)
    reference_step(filters, record, i)
    return int(departed(record, i))


@compiled
def sample_step(
    settings: Any,
    model: Any,
    loop_state: Any,
    sensors: Any,
    faults: Any,
    filters: Any,
    record: Any,
    table: Any,
    i: int,
) -> int:
    """From the truth in row `i` to its commands: `perceive`, then `outer_loop_step`."""
    reason = perceive(sensors, faults, filters, record, table, i)
    if reason == FLYING:
        outer_loop_step(settings, model, loop_state, record, i)
    return reason


@compiled
def point_mass_flight(
    settings: Any,
    model: Any,
    loop_state: Any,
    plant_state: Any,
    wind: Any,
    sensors: Any,
    faults: Any,
    filters: Any,
    record: Any,
    table: Any,
    first: int,
    beyond: int,
    dt: float,
    substeps: int,
) -> tuple[int, int]:
    """Fly rows `first` to `beyond - 1` of a recording.

    Args:
        settings, model, loop_state, sensors, faults, filters, record, table: as `sample_step` takes them.
        plant_state, dt, substeps: as `point_mass_step` takes them.
        wind: (1,) WIND.
        first, beyond: range of rows.

    Returns:
        The last row that was begun, and why it was not flown on from (FLYING if it was).
    """
    for i in range(first, beyond):
        point_mass_truth(model, wind, plant_state, record, i, dt)
        reason = sample_step(
            settings, model, loop_state, sensors, faults, filters, record, table, i
        )
        if reason != FLYING:
            return i, reason
        point_mass_step(model, wind, plant_state, record, i, dt, substeps)
    return beyond - 1, FLYING
