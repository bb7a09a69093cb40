"""`fly`: one scenario, one model, one loop, from trim to the end."""

import time
from collections.abc import Sequence

from ftc_jsb.errors import UserError
from ftc_jsb.interruption import interruptible
from ftc_jsb.loops.fence import fenced
from ftc_jsb.recording.flight import Flight, Outcome
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.admissible_faults import refuse_unflyable
from ftc_jsb.simulation.advance import Observer as Observer
from ftc_jsb.simulation.advance import advance
from ftc_jsb.simulation.assembly import assemble
from ftc_jsb.simulation.command_source import CommandSource
from ftc_jsb.simulation.departure import FLYING, REASONS
from ftc_jsb.simulation.plant import Plant
from ftc_jsb.simulation.steering import Steering


def fly(
    scenario: Scenario,
    observers: Sequence[Observer] = (),
    plant: Plant | None = None,
    commands: CommandSource | None = None,
) -> Flight:
    """Fly `scenario` with its model and loop.

    Args:
        scenario: as loaded; `scenario.model` and `scenario.loop.name` say what is flown.
        observers: called after every sample with the recording and the row; they watch only. One with
            an attribute `coarse` that is true may be called every `advance.STRETCH` samples instead.
        plant: in place of the model's own (a user's aircraft, an independent integration).
        commands: from a ground station or a recording, applied between samples; none before row 1.

    Returns:
        The flight, complete or up to where it departed, was ended or was interrupted.

    Raises:
        UserError: an aircraft, loop or trim that cannot be had, or a fault that the model has not. A
            loop that fails in flight does not raise: the flight ends there, `outcome.status` "failed".
    """
    with fenced():
        return _fly(scenario, observers, plant, commands)


def _fly(
    scenario: Scenario,
    observers: Sequence[Observer],
    plant: Plant | None,
    commands: CommandSource | None,
) -> Flight:
    with interruptible():  # nothing is flown yet
        refuse_unflyable(scenario)
        flown = assemble(scenario, plant)
        advance_rows, length = advance(flown, observers)
    record, dt = flown.record, 1.0 / scenario.loop.rate
    steering = Steering(scenario, flown)
    outcome = Outcome("complete", scenario.duration, "")
    rows = 0
    started = time.perf_counter()
    try:
        with interruptible():
            while rows < record.size:
                beyond = min(rows + length, record.size)
                if commands is not None:
                    if rows > 0 and not steering.apply_all(commands.take(rows), rows):
                        outcome = Outcome("ended", rows * dt, "ended by command")
                        break
                    beyond = min(beyond, commands.next_row(rows))
                steering.reach(beyond)
                last, reason = advance_rows(rows, beyond)
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
        flown.plant.close()
    elapsed = time.perf_counter() - started
    return Flight(scenario, record[:rows], outcome, rows * dt / elapsed, tuple(steering.applied))
