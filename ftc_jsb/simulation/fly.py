"""`fly`: one scenario, one model, one loop, from trim to the end."""

import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy.typing as npt

from ftc_jsb.compiled import direct
from ftc_jsb.disturbance.sensors import Senses
from ftc_jsb.errors import UserError
from ftc_jsb.loops.built_in import CompiledLoop
from ftc_jsb.loops.registry import RecordedLoop
from ftc_jsb.recording.flight import Flight, Outcome
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.admissible_faults import refuse_unflyable
from ftc_jsb.simulation.assembly import blank_recording, parts, point_mass_of
from ftc_jsb.simulation.command_source import CommandSource
from ftc_jsb.simulation.departure import FLYING, REASONS
from ftc_jsb.simulation.plant import Plant
from ftc_jsb.simulation.steering import Steering

Observer = Callable[[npt.NDArray[Any], int], None]  # recording, row just completed
Advance = Callable[[int, int], tuple[int, int]]  # first row, row beyond -> last row, reason
STRETCH = 2000  # samples flown in one compiled call: Ctrl-C and progress wait for no more


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
    from ftc_jsb.simulation.point_mass_plant import PointMassPlant
    from ftc_jsb.simulation.sample import perceive, point_mass_flight, sample_step

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
