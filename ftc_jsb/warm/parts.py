"""Parts of a flight's kernels that can be compiled side by side, and the flights that are linked from them.

What a part compiles is code for kernels that call it (`called_kernel`); a flight links the parts and makes
machine code. How many kernels a part has is for the bar alone.
"""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compile_called
from ftc_jsb.warm.needs import ISOLATING, JSBSIM, POINT_MASS

if TYPE_CHECKING:
    from ftc_jsb.control.records import LoopArrays

LOOP, PLANT, ISOLATION = "loop", "plant", "isolation"


class Part(NamedTuple):
    """What can be compiled by itself."""

    meaning: str
    kernels: int  # about
    of: tuple[str, ...] = ()  # flights that it is a part of; none: it is a flight


PARTS = {
    ISOLATION: Part("isolation of faults", 68, (ISOLATING,)),
    LOOP: Part("outer loop and filters", 86, (POINT_MASS, JSBSIM, ISOLATING)),
    PLANT: Part("point mass, wind, instruments", 78, (POINT_MASS, JSBSIM, ISOLATING)),
    POINT_MASS: Part("flights of point masses", 3),
    JSBSIM: Part("flights of JSBSim", 6),
    ISOLATING: Part("flights of JSBSim with isolation", 8),
}
_SHORT = "duration=0.1"
_FLIGHTS = {
    POINT_MASS: ("model=paper", "loop.name=ftc"),
    JSBSIM: ("model=jsbsim", "loop.name=ftc"),
    ISOLATING: ("model=jsbsim", "loop.name=robust"),
}


def compile_part(name: str) -> None:
    """Compile one of PARTS in this process, and leave it on the disk."""
    if name in _FLIGHTS:
        from ftc_jsb.scenario.load import load_scenario
        from ftc_jsb.simulation.fly import fly

        fly(load_scenario("paper", [_SHORT, *_FLIGHTS[name]]))
    else:
        {LOOP: _compile_loop, PLANT: _compile_plant, ISOLATION: _compile_isolation}[name]()


def _compile_plant() -> None:
    from ftc_jsb.point_mass.motion import point_mass_step, point_mass_truth
    from ftc_jsb.scenario.load import load_scenario
    from ftc_jsb.simulation.assembly import assemble
    from ftc_jsb.simulation.point_mass_plant import PointMassPlant
    from ftc_jsb.simulation.sample import perceive

    flown = assemble(load_scenario("paper", [_SHORT]))
    plant, record = flown.plant, flown.record
    assert isinstance(plant, PointMassPlant)  # what the scenario `paper` is made of
    compile_called(perceive, flown.inputs, 0)
    compile_called(point_mass_truth, plant.arrays, record, 0, plant.dt)
    compile_called(point_mass_step, plant.arrays, record, 0, plant.dt, plant.substeps)


def _compile_loop() -> None:
    from ftc_jsb.control.outer_loop import outer_loop_step

    compile_called(outer_loop_step, _loop_arrays(), _recording(), 0)


def _compile_isolation() -> None:
    from ftc_jsb.control.believed_readings import isolate_faults

    loop = _loop_arrays()
    row = _recording()[0]
    compile_called(isolate_faults, loop.settings[0], loop.model[0], loop.state[0], row, 0)


def _loop_arrays() -> "LoopArrays":
    """As a loop has them; kernels are compiled for the types alone."""
    from ftc_jsb.control.records import LOOP_SETTINGS, LOOP_STATE, LoopArrays
    from ftc_jsb.point_mass.model import MODEL

    return LoopArrays(np.zeros(1, LOOP_SETTINGS), np.zeros(1, MODEL), np.zeros(1, LOOP_STATE))


def _recording() -> npt.NDArray[Any]:
    from ftc_jsb.recording.columns import ROW

    return np.zeros(1, ROW)
