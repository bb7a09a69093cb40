"""Many point-mass flights in one compiled call: dispersed cases of one scenario, numbers only.

The cases share reference, duration and rate; everything else may differ. Every flight is the one that
`fly` flies, sample for sample, but only its SUMMARY is kept: memory is that of one recording, however
many there are.
"""

import math
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled
from ftc_jsb.control.records import LoopArrays
from ftc_jsb.disturbance.faults import SCHEDULE, present
from ftc_jsb.disturbance.sensors import Instruments
from ftc_jsb.errors import ScenarioError
from ftc_jsb.loops.built_in import CompiledLoop
from ftc_jsb.point_mass.motion import PointMassArrays
from ftc_jsb.recording.columns import ROW, numbers
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.admissible_faults import refuse_unflyable
from ftc_jsb.simulation.assembly import assemble, blank_recording
from ftc_jsb.simulation.point_mass_plant import PointMassPlant
from ftc_jsb.simulation.sample import LoopInputs, PointMassFlight, point_mass_flight
from ftc_jsb.vocabulary.kernel_types import Numbers, Records

FIRST_SCHEDULED = list(ROW.names or ()).index(SCHEDULE[0])

SUMMARY = np.dtype(
    [
        ("reason", np.int64),  # 0, or why it departed: see `monitor.REASONS`
        ("rows", np.int64),  # flown
        ("rmse_airspeed", float),  # [m/s]
        ("rmse_flight_path", float),  # [rad]
        ("rmse_heading", float),  # [rad]
        ("peak_error_airspeed", float),  # [m/s]
        ("peak_load_factor", float),
        ("effectiveness_error", float),  # estimate less truth of the thrust's at the end
    ]
)


def fly_batch(scenarios: Iterable[Scenario]) -> npt.NDArray[Any]:
    """Fly point-mass scenarios, one after the other, without Python in between.

    Args:
        scenarios: of the models `paper` or `identified`, with a built-in loop, all with the same
            reference, duration and rate.

    Returns:
        (n,) SUMMARY.

    Raises:
        ScenarioError: a scenario that cannot be flown so.
        UserError: as `fly`.
    """
    record, cases = None, []
    for scenario in scenarios:
        refuse_unflyable(scenario)
        shared = (scenario.reference, scenario.duration, scenario.loop.rate)
        if record is None:
            record, expected = blank_recording(scenario), shared
        if shared != expected:
            raise ScenarioError("a batch: expected one reference, duration and loop.rate for all")
        cases.append(_case(scenario, record))
    if record is None:
        return np.zeros(0, SUMMARY)
    result = np.zeros(len(cases), SUMMARY)
    stacked = Cases(*(np.concatenate(column) for column in zip(*cases, strict=True)))
    fly_cases(stacked, record, numbers(record), 1.0 / expected[2], result)
    return result


class Cases(NamedTuple):
    """What the flights of a batch are made of: (n,) each, as a flight has one of them."""

    settings: npt.NDArray[Any]
    loop_model: npt.NDArray[Any]
    loop: npt.NDArray[Any]
    plant_model: npt.NDArray[Any]
    plant: npt.NDArray[Any]
    wind: npt.NDArray[Any]
    sensors: npt.NDArray[Any]
    faults: npt.NDArray[Any]  # (n, CAPACITY) FAULT
    command_filter: npt.NDArray[Any]
    altitude_hold: npt.NDArray[Any]
    substeps: npt.NDArray[np.int64]
    engines: npt.NDArray[np.int64]


def _case(scenario: Scenario, record: npt.NDArray[Any]) -> Cases:
    """One flight of a batch."""
    flown = assemble(scenario, record=record)
    plant, loop, (instruments, filters, hold) = flown.plant, flown.loop, flown.inputs
    if not isinstance(plant, PointMassPlant) or not isinstance(loop, CompiledLoop):
        raise ScenarioError("a batch: expected point masses with built-in loops")
    return Cases(
        loop.arrays.settings,
        loop.arrays.model,
        loop.arrays.state,
        plant.arrays.model,
        plant.arrays.state,
        plant.arrays.wind,
        instruments.sensors,
        instruments.faults[None],
        filters,
        hold,
        np.array([plant.substeps]),
        np.array([flown.setup.aircraft.thrust.engines]),
    )


@compiled
def fly_cases(cases: Cases, record: Records, table: Numbers, dt: float, result: Any) -> None:
    """Fly cases one after the other in the same recording.

    Args:
        cases: what they are made of.
        record, table: a blank recording, and its memory as numbers; it holds the last case after.
        dt: sample time [s].
        result: (n,) SUMMARY, written.
    """
    for c in range(result.size):
        for i in range(record.size):
            record[i].effectiveness_thrust_est = math.nan  # a loop without an estimator writes none
            record[i].fault_declared = 0.0
            row = table[i, FIRST_SCHEDULED : FIRST_SCHEDULED + len(SCHEDULE)]
            present(cases.faults[c], record[i].time, cases.engines[c], row)
        one = slice(c, c + 1)
        instruments = Instruments(cases.sensors[one], cases.faults[c], record, table)
        flight = PointMassFlight(
            LoopInputs(instruments, cases.command_filter[one], cases.altitude_hold[one]),
            LoopArrays(cases.settings[one], cases.loop_model[one], cases.loop[one], None),
            PointMassArrays(cases.plant_model[one], cases.wind[one], cases.plant[one]),
        )
        last, reason = point_mass_flight(flight, 0, record.size, dt, cases.substeps[c])
        summarize(record, last, result[c])
        result[c].reason = reason


@compiled
def summarize(record: Records, last: int, summary: Any) -> None:
    """Write the SUMMARY of rows 0 to `last` of a recording, but for the reason of its end."""
    airspeed, path, heading, worst, load = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(last + 1):
        row = record[i]
        error = row.airspeed - row.airspeed_ref
        worst = max(worst, abs(error))
        airspeed += error * error
        path += (row.flight_path_angle - row.flight_path_angle_ref) ** 2
        heading += (row.heading - row.heading_ref) ** 2
        load = max(load, abs(row.load_factor))
    rows = last + 1
    end = record[last]
    summary.rows = rows
    summary.rmse_airspeed = (airspeed / rows) ** 0.5
    summary.rmse_flight_path = (path / rows) ** 0.5
    summary.rmse_heading = (heading / rows) ** 0.5
    summary.peak_error_airspeed = worst
    summary.peak_load_factor = load
    summary.effectiveness_error = end.effectiveness_thrust_est - end.effectiveness_thrust
