"""Kernels compiled before they are needed, in as many processes at once as there are parts.

Numba compiles what a kernel calls when it compiles the kernel, in one thread. The large halves of a
sample, the loop and what is around it, are therefore compiled side by side first; the kernels that
call both then find them on the disk.
"""

import subprocess
import sys
import time
from collections.abc import Callable

from ftc_jsb.compiled import direct, is_first_run
from ftc_jsb.errors import UserError

Tell = Callable[[str], None]
STAGES = (("loop", "plant"), ("point-mass", "jsbsim"))  # the parts of a stage side by side
_SHORT = "duration=0.1"
_MEANING = {
    "loop": "the outer loop and its filters",
    "plant": "instruments, references and the point mass",
    "point-mass": "flights of point masses",
    "jsbsim": "flights of JSBSim",
}


def is_cold() -> bool:
    """Whether the kernels of a flight have yet to be compiled here."""
    return is_first_run("ftc_jsb.simulation.sample")


def warm(tell: Tell) -> float:
    """Compile the kernels of flights with every model.

    Args:
        tell: told what is being compiled, a line at a time.

    Returns:
        The time that it took [s].

    Raises:
        UserError: a part could not be compiled.
    """
    started = time.perf_counter()
    for number, stage in enumerate(STAGES, 1):
        tell(f"Compiling {number}/{len(STAGES)}: {'; '.join(_MEANING[part] for part in stage)} ...")
        command = (sys.executable, "-P", "-c")
        running = [
            subprocess.Popen(
                [*command, f"from ftc_jsb.warm import compile_part; compile_part({part!r})"]
            )
            for part in stage
        ]
        try:
            codes = [process.wait() for process in running]
        finally:
            for process in running:
                process.kill()
        if any(codes):
            raise UserError(f"compiling failed in {', '.join(stage)}; the message is above")
    return time.perf_counter() - started


def compile_part(part: str) -> None:
    """Compile one of the parts in this process, and leave it on the disk."""
    from ftc_jsb.scenario.load import load_scenario
    from ftc_jsb.simulation.fly import fly

    models = {"point-mass": "paper", "jsbsim": "jsbsim"}
    if part in models:
        fly(load_scenario("paper", [_SHORT, f"model={models[part]}"]))
    else:
        _compile_half(part)


def _compile_half(part: str) -> None:
    from ftc_jsb.control.outer_loop import outer_loop_step
    from ftc_jsb.loops.built_in import CompiledLoop
    from ftc_jsb.point_mass.motion import point_mass_step, point_mass_truth
    from ftc_jsb.scenario.load import load_scenario
    from ftc_jsb.simulation.assembly import assemble
    from ftc_jsb.simulation.point_mass_plant import PointMassPlant
    from ftc_jsb.simulation.sample import perceive

    flown = assemble(load_scenario("paper", [_SHORT]))
    plant, loop, record = flown.plant, flown.loop, flown.record
    assert isinstance(plant, PointMassPlant)  # what the scenario `paper` is made of
    assert isinstance(loop, CompiledLoop)
    if part == "loop":
        direct(outer_loop_step, loop.arrays, record, 0)
        return
    direct(perceive, flown.inputs, 0)
    direct(point_mass_truth, plant.arrays, record, 0, plant.dt)
    direct(point_mass_step, plant.arrays, record, 0, plant.dt, plant.substeps)
