"""Many point-mass flights in one compiled call: dispersed cases of one scenario, numbers only.

The cases share reference, duration and rate; everything else may differ. Every flight is the one that
`fly` flies, sample for sample, but only its SUMMARY is kept: memory is that of one recording, however
many there are.
"""

import math
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled
from ftc_jsb.disturbance.faults import SCHEDULE, present
from ftc_jsb.errors import ScenarioError
from ftc_jsb.loops.built_in import CompiledLoop
from ftc_jsb.recording.columns import ROW
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.admissible_faults import refuse_unflyable
from ftc_jsb.simulation.assembly import blank_recording, parts, point_mass_of
from ftc_jsb.simulation.point_mass_plant import PointMassPlant
from ftc_jsb.simulation.sample import point_mass_flight

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
        aircraft = point_mass_of(scenario)
        shared = (scenario.reference, scenario.duration, scenario.loop.rate)
        if record is None:
            record, expected = blank_recording(scenario), shared
        if shared != expected:
            raise ScenarioError("a batch: expected one reference, duration and loop.rate for all")
        plant, loop, filters, senses, _, _ = parts(scenario, aircraft, record)
        if not isinstance(plant, PointMassPlant) or not isinstance(loop, CompiledLoop):
            raise ScenarioError("a batch: expected point masses with built-in loops")
        flown = (loop.settings, plant.model, loop.state, plant.state, plant.wind)
        case = (*flown, senses.sensors, senses.faults[None], filters)
        cases.append((*case, np.array([plant.substeps]), np.array([aircraft.thrust.engines])))
    if record is None:
        return np.zeros(0, SUMMARY)
    stacked: list[Any] = [np.concatenate(column) for column in zip(*cases, strict=True)]
    result = np.zeros(len(cases), SUMMARY)
    table = record.view(np.float64).reshape(record.size, -1)
    fly: Callable[..., None] = fly_cases
    fly(*stacked, record, table, 1.0 / expected[2], result)
    return result


@compiled
def fly_cases(
    settings: Any,
    model: Any,
    loop_state: Any,
    plant_state: Any,
    wind: Any,
    sensors: Any,
    faults: Any,
    filters: Any,
    substeps: Any,
    engines: Any,
    record: Any,
    table: Any,
    dt: float,
    result: Any,
) -> None:
    """Fly cases one after the other in the same recording.

    Args:
        settings, model, loop_state, plant_state, wind, sensors, filters: (n,), each as
            `point_mass_flight` takes one of them.
        faults: (n, CAPACITY) FAULT.
        substeps, engines: (n,).
        record, table: a blank recording, and its memory as numbers; it holds the last case after.
        dt: sample time [s].
        result: (n,) SUMMARY, written.
    """
    for c in range(result.size):
        for i in range(record.size):
            record[i].effectiveness_thrust_est = math.nan  # a loop without an estimator writes none
            record[i].fault_declared = 0.0
            row = table[i, FIRST_SCHEDULED : FIRST_SCHEDULED + len(SCHEDULE)]
            present(faults[c], record[i].time, engines[c], row)
        last, reason = point_mass_flight(
            settings[c : c + 1],
            model[c : c + 1],
            loop_state[c : c + 1],
            plant_state[c : c + 1],
            wind[c : c + 1],
            sensors[c : c + 1],
            faults[c],
            filters[c : c + 1],
            record,
            table,
            0,
            record.size,
            dt,
            substeps[c],
        )
        summarize(record, last, result[c])
        result[c].reason = reason


@compiled
def summarize(record: Any, last: int, summary: Any) -> None:
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
