"""What must hold before an outer loop takes over a JSBSim instance of the user's own."""

from typing import Any

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.errors import AircraftError, LoopError
from ftc_jsb.simulation.admissible_faults import SLOWEST_JSBSIM
from ftc_jsb.six_dof.engines import engine_count


def check_aircraft(fdm: Any, aircraft: Aircraft) -> None:
    """See that the instance flies this aircraft, woven, set up, with its engines running.

    Raises:
        AircraftError: it does not.
    """
    model = fdm.get_model_name()
    if not model:
        raise AircraftError(
            "the FGFDMExec has no aircraft; load one with load_woven(fdm, name, dt)"
        )
    if model != aircraft.jsbsim_model:
        raise AircraftError(
            f"the FGFDMExec flies {model!r}; aircraft {aircraft.name!r} is {aircraft.jsbsim_model!r}"
        )
    try:
        fdm["ftc/command/thrust-n"]
    except KeyError:
        raise AircraftError(
            f"{model!r} in the FGFDMExec has no inner loop (no property 'ftc/command/thrust-n'): load "
            f"the woven aircraft with load_woven(fdm, {aircraft.name!r}, dt), or from woven_root()"
        ) from None
    for name, value in aircraft.setup.items():
        if abs(fdm[name] - value) > 1e-6:
            raise AircraftError(
                f"{name} is {fdm[name]:g}, expected {value:g} before the trim (load_woven sets it)"
            )
    for number in range(engine_count(fdm)):
        if fdm[f"propulsion/engine[{number}]/set-running"] != 1.0:
            raise AircraftError(
                f"engine {number} does not run; after run_ic: fdm['propulsion/set-running'] = -1"
            )


def steps_per_sample(dt: float, rate: float) -> int:
    """JSBSim steps of `dt` seconds in a sample of a loop at `rate` Hz.

    Raises:
        LoopError: the step does not divide the period, or is too long for the inner loop.
    """
    steps = round(1.0 / (rate * dt))
    if steps < 1 or abs(steps * dt * rate - 1.0) > 1e-6:
        raise LoopError(
            f"time step {dt:g} s does not divide the loop's period of {1.0 / rate:g} s "
            f"(loop.rate {rate:g} Hz); try fdm.set_dt({1.0 / (rate * max(1, steps)):g})"
        )
    if 1.0 / dt < SLOWEST_JSBSIM:
        raise LoopError(
            f"time step {dt:g} s: {1.0 / dt:g} Hz; the inner loop needs at least {SLOWEST_JSBSIM:g} Hz"
        )
    return steps
