"""What happens between two samples of a plant, in one compiled call, and whole stretches of point-mass flight.

`fly` takes a sample of any plant with `perceive` and `sample_step`; a point mass flies on without
Python. The kernels are the same and in the same order, so the flight is the same to the bit (a test
compares).
"""

from typing import Any, NamedTuple

import numpy.typing as npt

from ftc_jsb.compiled import compiled
from ftc_jsb.control.altitude_hold import hold_altitude, plan_as_reference
from ftc_jsb.control.command_filter import reference_step
from ftc_jsb.control.outer_loop import outer_loop_step
from ftc_jsb.control.records import LoopArrays
from ftc_jsb.disturbance.sensors import Instruments, measure
from ftc_jsb.point_mass.motion import PointMassArrays, point_mass_step, point_mass_truth
from ftc_jsb.simulation.departure import FLYING, departed


class LoopInputs(NamedTuple):
    """What stands between a plant and its loop: instruments, and what makes the references."""

    instruments: Instruments
    command_filter: npt.NDArray[Any]  # (1,) COMMAND_FILTER
    altitude_hold: npt.NDArray[Any]  # (1,) ALTITUDE_HOLD


class PointMassFlight(NamedTuple):
    """All that a point-mass flight is made of."""

    inputs: LoopInputs
    loop: LoopArrays
    plant: PointMassArrays


@compiled
def perceive(inputs: LoopInputs, i: int) -> int:
    """From the truth in row `i`: what is measured, what is to be tracked, and whether it still flies.

    Returns:
        Why the flight has departed; FLYING if it has not.
    """
    measure(inputs.instruments, i)
    hold_altitude(inputs.altitude_hold, inputs.instruments.record, i)
    reference_step(inputs.command_filter, inputs.instruments.record, i)
    plan_as_reference(inputs.altitude_hold, inputs.command_filter)
    return int(departed(inputs.instruments.record, i))


@compiled
def sample_step(inputs: LoopInputs, loop: LoopArrays, i: int) -> int:
    """From the truth in row `i` to its commands: `perceive`, then `outer_loop_step`."""
    reason = perceive(inputs, i)
    if reason == FLYING:
        outer_loop_step(loop, inputs.instruments.record, i)
    return reason


@compiled
def point_mass_flight(
    flight: PointMassFlight, first: int, beyond: int, dt: float, substeps: int
) -> tuple[int, int]:
    """Fly rows `first` to `beyond - 1` of a recording.

    Args:
        flight: what it is made of.
        first, beyond: range of rows.
        dt: sample time [s].
        substeps: Runge-Kutta steps a sample.

    Returns:
        The last row that was begun, and why it was not flown on from (FLYING if it was).
    """
    record = flight.inputs.instruments.record
    for i in range(first, beyond):
        point_mass_truth(flight.plant, record, i, dt)
        reason = sample_step(flight.inputs, flight.loop, i)
        if reason != FLYING:
            return i, reason
        point_mass_step(flight.plant, record, i, dt, substeps)
    return beyond - 1, FLYING
