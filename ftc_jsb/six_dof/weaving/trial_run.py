"""Run by `trial.py` as a program: loads an aircraft, initialises and trims it, flies some frames.

Whether JSBSim likes the aircraft is not asked here, but only whether the process is still there.
"""

import contextlib
import sys

DT = 0.005  # s


def fly(model: str, root: str) -> None:
    """Load, trim and fly, and be rid of it: JSBSim may abort there, too.

    Args:
        model: of JSBSim.
        root: folder with `aircraft/`, `engine/`, `systems/`.
    """
    import jsbsim

    fdm = jsbsim.FGFDMExec(None)
    fdm.set_debug_level(0)
    fdm.set_dt(DT)
    aircraft, engine, systems = (f"{root}/{part}" for part in ("aircraft", "engine", "systems"))
    with contextlib.suppress(Exception):
        fdm.load_model_with_paths(model, aircraft, engine, systems, True)
        initial = (("h-sl-ft", 10_000.0), ("vt-fps", 800.0))  # ft, ft/s
        for name, value in (
            *((f"ic/{key}", value) for key, value in initial),
            ("gear/gear-cmd-norm", 0.0),
        ):
            fdm[name] = value
        fdm.run_ic()
        fdm["propulsion/set-running"] = -1
        for _ in range(3):
            fdm.run()
        fdm["simulation/do_simple_trim"] = 1
        for _ in range(20):
            fdm.run()


if __name__ == "__main__":
    fly(*sys.argv[1:])
    print("\nsurvived", flush=True)
