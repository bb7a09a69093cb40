"""`fly`: one scenario, one model, one loop, from trim to the end."""

import math
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import direct
from ftc_jsb.control.command_filter import command_filter
from ftc_jsb.control.loops import CompiledLoop, RecordedLoop, build_loop
from ftc_jsb.control.protocol import LoopSetup
from ftc_jsb.disturbance.faults import fault_records, schedule
from ftc_jsb.disturbance.sensors import Senses, sensor_record
from ftc_jsb.disturbance.weather import wind_record
from ftc_jsb.errors import ScenarioError, UserError
from ftc_jsb.point_mass.parameters import PointMass, load_point_mass
from ftc_jsb.resources import PAPER_AIRCRAFT, aircraft_folder
from ftc_jsb.scenario.reference import raw_commands
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.commands import CommandSource
from ftc_jsb.simulation.flight import Flight, Outcome
from ftc_jsb.simulation.monitor import FLYING, REASONS
from ftc_jsb.simulation.plant import Plant
from ftc_jsb.simulation.possible import impossible
from ftc_jsb.simulation.steering import Steering
from ftc_jsb.simulation.variables import ROW, numbers

Observer = Callable[[npt.NDArray[Any], int], None]  # recording, row just completed
Advance = Callable[[int, int], tuple[int, int]]  # first row, row beyond -> last row, reason
STRETCH = 2000  # samples flown in one compiled call: Ctrl-C and progress wait for no more
SLOWEST_JSBSIM = 80.0  # [Hz]: the inner loop's bandwidth of 36 1/s with a margin


def fly(
    scenario: Scenario,
    observers: Sequence[Observer] = (),
    plant: Plant | None = None,
    commands: CommandSource | None = None,
    output: Path | None = None,
) -> Flight:
    """Fly `scenario` with its model and loop.

    Args:
        scenario: as loaded; `scenario.model` and `scenario.loop.name` say what is flown.
        observers: called after every sample with the recording and the row; they watch only. One with
            an attribute `coarse` that is true may be called every STRETCH samples instead.
        plant: in place of the model's own (a user's aircraft, an independent integration).
        commands: from a ground station or a recording, applied between samples; none before row 1.
        output: JSBSim's output directive (`six_dof.flightgear`), by its absolute path.

    Returns:
        The flight, complete or up to where it departed, was ended or was interrupted.

    Raises:
        UserError: an aircraft, loop or trim that cannot be had, or a fault that the model has not. A
            loop that fails in flight does not raise: the flight ends there, `outcome.status` "failed".
    """
    refuse_unflyable(scenario)
    aircraft = point_mass_of(scenario)
    record = blank_recording(scenario, aircraft.thrust.engines)
    dt = 1.0 / scenario.loop.rate
    plant, loop, filters, senses, setup, model = parts(scenario, aircraft, record, plant, output)
    outcome = Outcome("complete", scenario.duration, "")
    rows = 0
    advance, length = _advance(plant, loop, observers, filters, senses)
    steering = Steering(setup, scenario, model, loop, senses)
    started = time.perf_counter()
    try:
        while rows < record.size:
            beyond = min(rows + length, record.size)
            if commands is not None:
                if rows > 0 and not _steered(steering, commands, rows):
                    outcome = Outcome("ended", rows * dt, "ended by command")
                    break
                beyond = min(beyond, commands.next_row(rows))
            last, reason = advance(rows, beyond)
            rows = last + 1
            if reason != FLYING:
                outcome = Outcome("departed", last * dt, REASONS[reason])
                break
            for observe in observers:
                observe(record, last)
    except UserError as error:
        rows = max(rows, 1)  # a row that has not been flown is not kept, but for the first
        outcome = Outcome("failed", (rows - 1) * dt, str(error))
    except KeyboardInterrupt:
        rows = max(rows, 1)
        outcome = Outcome("interrupted", rows * dt, "interrupted")
    finally:
        plant.close()
    elapsed = time.perf_counter() - started
    return Flight(scenario, record[:rows], outcome, rows * dt / elapsed, tuple(steering.applied))


def _steered(steering: Steering, commands: CommandSource, row: int) -> bool:
    """Apply what is to be applied before `row`; whether the flight goes on."""
    return all(steering.apply(command, row) for command in commands.take(row))


class Parts(NamedTuple):
    """What a flight is made of, at rest at its start."""

    plant: Plant
    loop: RecordedLoop
    filters: npt.NDArray[Any]  # (1,) COMMAND_FILTER
    senses: Senses
    setup: LoopSetup
    model: npt.NDArray[Any]  # (1,) MODEL that the loop counts on


def parts(
    scenario: Scenario,
    aircraft: PointMass,
    record: npt.NDArray[Any],
    plant: Plant | None = None,
    output: Path | None = None,
) -> Parts:
    """Plant, loop, command filter and sensors of a scenario, bound to a blank recording.

    Args:
        scenario: to be flown.
        aircraft: of `point_mass_of`.
        record: of `blank_recording`.
        plant: in place of the model's own.
        output: as `fly` takes it.

    Raises:
        UserError: one of them cannot be had.
    """
    fuel = scenario.aircraft.fuel_fraction
    model = aircraft.record(fuel)
    dt = 1.0 / scenario.loop.rate
    if plant is None:
        plant = build_plant(scenario, model, dt, output)
    setup = LoopSetup(aircraft, aircraft.initial_mass(fuel), scenario.loop, dt, scenario.sensors)
    first = [record[0][f"{name}_cmd_raw"] for name in ("airspeed", "flight_path_angle", "heading")]
    reference = scenario.reference
    start = (0.0, 0.0, scenario.initial.altitude)
    filters = command_filter(reference.filter_frequency, reference.filter_damping, dt, first, start)
    loop = build_loop(setup, model, record)
    plant.reset(record)
    faults = fault_records(scenario.fault)
    senses = Senses(sensor_record(scenario, record), faults, record, numbers(record))
    return Parts(plant, loop, filters, senses, setup, model)


def _advance(
    plant: Plant,
    loop: RecordedLoop,
    observers: Sequence[Observer],
    filters: npt.NDArray[Any],
    senses: Senses,
) -> tuple[Advance, int]:
    """How this flight goes on, and by how many rows at a time.

    In compiled stretches where nothing needs Python in between; else a sample at a time: another
    plant, a user's loop, an observer of every sample.
    """
    from ftc_jsb.point_mass.plant import PointMassPlant
    from ftc_jsb.simulation.fused import perceive, point_mass_flight, sample_step

    sensors, faults, record, table = senses
    seen = (sensors, faults, filters, record, table)
    coarse = all(getattr(observe, "coarse", False) for observe in observers)
    if isinstance(plant, PointMassPlant) and isinstance(loop, CompiledLoop) and coarse:
        aircraft = (loop.settings, plant.model, loop.state, plant.state, plant.wind)
        fixed = (*aircraft, sensors, faults, filters, record, table)
        pace = (plant.dt, plant.substeps)
        run = partial(direct(point_mass_flight, *fixed, 0, 1, *pace), *fixed)
        return lambda first, beyond: run(first, beyond, *pace), STRETCH
    truth, step = plant.truth, plant.step
    if isinstance(loop, CompiledLoop):
        decision = (loop.settings, loop.model, loop.state, *seen)
        decide = partial(direct(sample_step, *decision, 0), *decision)

        def decided(i: int, _: int) -> tuple[int, int]:
            truth(i)
            reason: int = decide(i)
            if reason == FLYING:
                step(i)
            return i, reason

        return decided, 1
    notice = partial(direct(perceive, *seen, 0), *seen)

    def sample(i: int, _: int) -> tuple[int, int]:
        truth(i)
        reason: int = notice(i)
        if reason == FLYING:
            loop.step(i)
            step(i)
        return i, reason

    return sample, 1


def refuse_unflyable(scenario: Scenario) -> None:
    """See that the model can have the scenario's faults.

    Raises:
        ScenarioError: it cannot.
    """
    for index, fault in enumerate(scenario.fault):
        reason = impossible(scenario, fault)
        if reason:
            raise ScenarioError(f"fault[{index}].target: {reason}")
    frames = scenario.loop.rate * scenario.simulation.jsbsim_steps
    if scenario.model == "jsbsim" and frames < SLOWEST_JSBSIM:
        raise ScenarioError(
            f"loop.rate x simulation.jsbsim_steps: {frames:g} Hz; the inner loop needs at least "
            f"{SLOWEST_JSBSIM:g} Hz"
        )


def point_mass_of(scenario: Scenario) -> PointMass:
    """The point mass that the outer loop of this scenario counts on.

    Raises:
        AircraftError: no such aircraft.
    """
    name = PAPER_AIRCRAFT if scenario.model == "paper" else scenario.aircraft.name
    return load_point_mass(aircraft_folder(name))


def build_plant(
    scenario: Scenario, model: npt.NDArray[Any], dt: float, output: Path | None = None
) -> Plant:
    """The plant of `scenario.model`; an output directive is for JSBSim."""
    simulation = scenario.simulation
    if scenario.model == "jsbsim":
        from ftc_jsb.six_dof.plant import JsbsimPlant

        steps, air, seed = simulation.jsbsim_steps, scenario.wind, scenario.seed
        return JsbsimPlant(scenario.aircraft, scenario.initial, dt, steps, air, seed, output)
    from ftc_jsb.point_mass.plant import PointMassPlant

    wind = wind_record(scenario.wind, scenario.initial.altitude, scenario.seed, dryden=True)
    return PointMassPlant(model, wind, scenario.initial, dt, simulation.point_mass_steps)


def blank_recording(scenario: Scenario, engines: int = 1) -> npt.NDArray[Any]:
    """Recording with time, raw commands and faults filled in, the rest nan.

    (rows,) of ROW: one row a sample and one for the end. What is scheduled, commands and faults,
    stands in the recording before the flight; whoever changes it in flight rewrites the rows to come.
    """
    record = np.empty(scenario.samples + 1, ROW)
    numbers(record).fill(math.nan)
    record["time"] = np.arange(record.size) / scenario.loop.rate
    commands = raw_commands(scenario.reference, record["time"])
    record["airspeed_cmd_raw"] = commands[:, 0]
    record["flight_path_angle_cmd_raw"] = commands[:, 1]
    record["heading_cmd_raw"] = commands[:, 2]
    schedule(fault_records(scenario.fault), engines, record)
    return record
