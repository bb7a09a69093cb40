"""A woven aircraft loaded into a fresh `jsbsim.FGFDMExec`."""

from pathlib import Path
from typing import Any

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.errors import AircraftError, TrimError


def load(aircraft: Aircraft, root: Path, dt: float) -> Any:
    """A fresh `jsbsim.FGFDMExec` with the woven aircraft loaded.

    Args:
        aircraft: as loaded.
        root: of the woven aircraft.
        dt: JSBSim's time step [s].

    Raises:
        AircraftError: JSBSim refuses the aircraft; carries what JSBSim said.
    """
    return load_from(aircraft.name, aircraft.jsbsim_model, root, dt)


def load_from(name: str, model: str, root: Path, dt: float) -> Any:
    """A fresh `jsbsim.FGFDMExec` with an aircraft loaded.

    Args:
        name: for messages.
        model: of JSBSim.
        root: folder with `aircraft/`, `engine/`, `systems/`.
        dt: JSBSim's time step [s].

    Raises:
        AircraftError: JSBSim refuses the aircraft; carries what JSBSim said.
    """
    import jsbsim

    listener = _listener()
    jsbsim.set_logger(listener)
    fdm = jsbsim.FGFDMExec(None)
    fdm.set_debug_level(0)
    fdm.set_dt(dt)  # before loading: actuators and filters take their time step when they are read
    listener.text = ""  # the banner
    try:
        aircraft, engine, systems = root / "aircraft", root / "engine", root / "systems"
        loaded = fdm.load_model_with_paths(model, str(aircraft), str(engine), str(systems), True)
    except Exception as error:
        said = " ".join(f"{error} {listener.text}".split())[:400]
        raise AircraftError(f"aircraft {name!r}: JSBSim: {said}") from None
    if not loaded:
        said = " ".join(listener.text.split())[:400]
        raise AircraftError(f"aircraft {name!r}: JSBSim cannot load it: {said}")
    return fdm


def initialise(fdm: Any, name: str) -> None:
    """`run_ic`, with the failures of JSBSim in a sentence.

    Args:
        fdm: loaded, with its initial condition set.
        name: of the aircraft, for messages.

    Raises:
        AircraftError: JSBSim raised, for an unknown property, say.
        TrimError: it refuses the initial condition.
    """
    try:
        accepted = fdm.run_ic()
    except Exception as error:
        said = " ".join(str(error).split())[:400]
        raise AircraftError(f"aircraft {name!r}: JSBSim: {said}") from None
    if not accepted:
        raise TrimError(f"aircraft {name!r}: JSBSim refuses the initial condition")


def _listener() -> Any:
    """A JSBSim logger that keeps what JSBSim says in `text`, in place of its console output."""
    import jsbsim

    class Listener(jsbsim.FGLogger):
        """JSBSim's logger interface."""

        def __init__(self) -> None:
            super().__init__()
            self.text = ""

        def set_level(self, level: Any) -> None:
            pass

        def file_location(self, filename: str, line: int) -> None:
            self.text += f"{filename}:{line}: "

        def message(self, message: str) -> None:
            self.text += message

        def format(self, format_: Any) -> None:
            pass

        def flush(self) -> None:
            pass

    return Listener()
