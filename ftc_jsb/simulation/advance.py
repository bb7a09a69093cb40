"""How a flight goes on from row to row: in compiled stretches where it can, else a sample at a time."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy.typing as npt

from ftc_jsb.compiled import direct
from ftc_jsb.loops.built_in import CompiledLoop
from ftc_jsb.simulation.assembly import Assembly
from ftc_jsb.simulation.departure import FLYING
from ftc_jsb.simulation.point_mass_plant import PointMassPlant
from ftc_jsb.simulation.sample import PointMassFlight, perceive, point_mass_flight, sample_step

Observer = Callable[[npt.NDArray[Any], int], None]  # recording, row just completed
Advance = Callable[[int, int], tuple[int, int]]  # first row, row beyond -> last row, reason
STRETCH = 2000  # samples flown in one compiled call: Ctrl-C and progress wait for no more


def advance(flown: Assembly, observers: Sequence[Observer]) -> tuple[Advance, int]:
    """How this flight goes on, and by how many rows at a time.

    In compiled stretches where nothing needs Python in between; else a sample at a time: another
    plant, a user's loop, an observer of every sample.
    """
    plant, loop = flown.plant, flown.loop
    coarse = all(getattr(observe, "coarse", False) for observe in observers)
    if isinstance(loop, CompiledLoop):
        if isinstance(plant, PointMassPlant) and coarse:
            return _stretches(plant, loop, flown), STRETCH
        return _samples_with_built_in_loop(loop, flown), 1
    return _samples_with_own_loop(flown), 1


def _stretches(plant: PointMassPlant, loop: CompiledLoop, flown: Assembly) -> Advance:
    # A point mass has no gyros and no surfaces: nothing is isolated, whatever the settings say.
    flight = PointMassFlight(flown.inputs, loop.arrays._replace(isolates=None), plant.arrays)
    pace = (plant.dt, plant.substeps)
    run = direct(point_mass_flight, flight, 0, 1, *pace)

    def stretch(first: int, beyond: int) -> tuple[int, int]:
        last, reason = run(flight, first, beyond, *pace)
        return last, reason

    return stretch


def _samples_with_built_in_loop(loop: CompiledLoop, flown: Assembly) -> Advance:
    truth, step = flown.plant.truth, flown.plant.step
    seen = (flown.inputs, loop.arrays)
    decide = partial(direct(sample_step, *seen, 0), *seen)

    def sample(i: int, _: int) -> tuple[int, int]:
        truth(i)
        reason: int = decide(i)
        if reason == FLYING:
            step(i)
        return i, reason

    return sample


def _samples_with_own_loop(flown: Assembly) -> Advance:
    truth, step, loop_step = flown.plant.truth, flown.plant.step, flown.loop.step
    notice = partial(direct(perceive, flown.inputs, 0), flown.inputs)

    def sample(i: int, _: int) -> tuple[int, int]:
        truth(i)
        reason: int = notice(i)
        if reason == FLYING:
            loop_step(i)
            step(i)
        return i, reason

    return sample
