"""The woven aircraft in a JSBSim instance of the user's own."""

from pathlib import Path
from typing import Any, Literal

from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.errors import AircraftError
from ftc_jsb.six_dof.properties import write_checked
from ftc_jsb.six_dof.weaving.woven_aircraft import woven_aircraft

FlightControl = Literal["corrected", "stock"]


def woven_root(aircraft: str, flight_control: FlightControl = "corrected") -> Path:
    """Folder with `aircraft/`, `engine/` and `systems/` of the woven aircraft, for JSBSim to load.

    Args:
        aircraft: name of a shipped aircraft, or the path of a folder.
        flight_control: with the corrections of `aircraft.toml`, or as shipped with JSBSim.

    Raises:
        AircraftError: there is no such aircraft, or it cannot be woven.
    """
    return woven_aircraft(load_aircraft(aircraft), flight_control == "corrected")


def load_woven(
    fdm: Any, aircraft: str, dt: float, flight_control: FlightControl = "corrected"
) -> None:
    """Load the woven aircraft into the user's `FGFDMExec` and set it up (gear, switches).

    To be called before `run_ic`. Initial condition, fuel and trim are the user's. The time step is
    set before loading: JSBSim's actuators and filters take it when they are read.

    Args:
        fdm: the user's instance.
        aircraft: name of a shipped aircraft, or the path of a folder.
        dt: JSBSim's time step [s].
        flight_control: corrected or stock.

    Raises:
        AircraftError: JSBSim does not take it.
    """
    root = woven_root(aircraft, flight_control)
    loaded = load_aircraft(aircraft)
    fdm.set_dt(dt)
    folders = (str(root / part) for part in ("aircraft", "engine", "systems"))
    if not fdm.load_model_with_paths(loaded.jsbsim_model, *folders, True):
        raise AircraftError(f"aircraft {loaded.name!r}: JSBSim cannot load it from {root}")
    for name, value in loaded.setup.items():
        write_checked(fdm, name, value)
