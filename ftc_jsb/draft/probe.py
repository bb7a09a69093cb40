"""An aircraft held still in the air, to see what answers its commands and what forces act."""

from pathlib import Path
from typing import Any

from ftc_jsb.six_dof.loading import initialise, load_from
from ftc_jsb.units import FOOT

DT = 0.02  # [s]
INTEGRATORS = (
    "rate/rotational",
    "rate/translational",
    "position/rotational",
    "position/translational",
)
SETTLED = 2.0  # [s] by which a surface has arrived


def loaded(model: str, root: Path) -> Any:
    """A fresh `jsbsim.FGFDMExec` with an aircraft.

    Args:
        model: of JSBSim.
        root: folder with `aircraft/`, `engine/`, `systems/`.

    Raises:
        AircraftError: JSBSim refuses it.
    """
    return load_from(model, model, root, DT)


def hold(fdm: Any, airspeed: float, altitude: float, alpha: float) -> None:
    """Place an aircraft, wings level, and stop its motion: time, systems and engines go on.

    Args:
        fdm: of `loaded`.
        airspeed: true [m/s].
        altitude: [m].
        alpha: angle of attack [rad].

    Raises:
        AircraftError: JSBSim refuses the condition, such as for a property that it lacks.
    """
    fdm["ic/h-sl-ft"] = altitude / FOOT
    fdm["ic/vt-fps"] = airspeed / FOOT
    fdm["ic/alpha-rad"] = alpha
    initialise(fdm, fdm.get_model_name())
    for name in INTEGRATORS:
        fdm[f"simulation/integrator/{name}"] = 0.0


def settle(fdm: Any, seconds: float = SETTLED) -> None:
    """Let surfaces arrive where commands send them."""
    for _ in range(round(seconds / DT)):
        fdm.run()
