"""The JSBSim aircraft as a plant: commands into the woven inner loop, state and measurements out."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import direct
from ftc_jsb.errors import AircraftError
from ftc_jsb.scenario.schema import AircraftChoice, Initial
from ftc_jsb.six_dof.aircraft import load_aircraft
from ftc_jsb.six_dof.engine_deck import EFFECTIVENESS
from ftc_jsb.six_dof.observation import JSBSIM_STATE, PROPERTIES, THRUST, observe
from ftc_jsb.six_dof.properties import engine_count, readers, writer
from ftc_jsb.six_dof.trim import trimmed
from ftc_jsb.six_dof.weaving import woven_aircraft
from ftc_jsb.units import FOOT, POUND_FORCE


class JsbsimPlant:
    """A `Plant` on a woven JSBSim aircraft, one fresh FGFDMExec a flight."""

    def __init__(self, choice: AircraftChoice, initial: Initial, dt: float, steps: int) -> None:
        """Args: the scenario's [aircraft] and [initial]; sample time [s]; JSBSim steps a sample."""
        self._choice = choice
        self._initial = initial
        self._steps = steps
        self._dt = dt / steps
        self._state = np.zeros(1, JSBSIM_STATE)

    def reset(self, record: npt.NDArray[Any]) -> None:
        """Weave, load, trim, check and engage; binds the recording to write to.

        Raises:
            AircraftError, TrimError: with the property or the residuals.
        """
        aircraft = load_aircraft(self._choice.name)
        root = woven_aircraft(aircraft, self._choice.flight_control == "corrected")
        fdm = trimmed(aircraft, root, self._dt, self._initial, self._choice.fuel_fraction)
        self.fdm = fdm
        positions = aircraft.positions
        names = list(PROPERTIES)
        names += [
            positions.throttle,
            positions.elevator,
            positions.aileron,
            positions.rudder,
            positions.flap,
        ]
        engines = engine_count(fdm)
        names += [f"propulsion/engine[{number}]/thrust-lbs" for number in range(engines)]
        self._readers = readers(fdm, names)
        self._raw = np.zeros(len(names))
        self._command_thrust = writer(fdm, "ftc/command/thrust-n")
        self._command_load_factor = writer(fdm, "ftc/command/load-factor")
        self._command_bank = writer(fdm, "ftc/command/bank-rad")
        self._effectiveness: list[Callable[[float], Any]] = [
            writer(fdm, f"{EFFECTIVENESS}[{number}]") for number in range(engines)
        ]
        self._record = record
        self._observe = direct(observe, self._raw, self._state, record, 0)
        self._place_origin(fdm)
        self._command_thrust(sum(fdm[name] for name in names[THRUST:]) * POUND_FORCE)
        self._command_load_factor(math.cos(math.radians(self._initial.flight_path_deg)))
        self._command_bank(0.0)
        writer(fdm, "ftc/engaged")(1.0)

    def _place_origin(self, fdm: Any) -> None:
        state = self._state[0]
        state["origin"] = [fdm[f"position/ecef-{axis}-ft"] * FOOT for axis in "xyz"]
        latitude = math.radians(self._initial.latitude_deg)
        longitude = math.radians(self._initial.longitude_deg)
        state["north"] = (
            -math.sin(latitude) * math.cos(longitude),
            -math.sin(latitude) * math.sin(longitude),
            math.cos(latitude),
        )
        state["east"] = (-math.sin(longitude), math.cos(longitude), 0.0)
        state["heading"] = state["yaw"] = math.radians(self._initial.heading_deg)

    def truth(self, i: int) -> None:
        """Write state and measurements to row `i`."""
        self._raw[:] = [read() for read in self._readers]
        self._observe(self._raw, self._state, self._record, i)

    def step(self, i: int) -> None:
        """Fly the commands of row `i` for one sample.

        Raises:
            AircraftError: JSBSim raised, or says that it is over.
        """
        row = self._record[i]
        self._command_thrust(float(row["thrust_cmd"]))
        self._command_load_factor(float(row["load_factor_cmd"]))
        self._command_bank(float(row["bank_angle_cmd"]))
        effectiveness = float(row["effectiveness_thrust"])
        for engine in self._effectiveness:
            engine(effectiveness)
        run = self.fdm.run
        try:
            for _ in range(self._steps):
                if not run():
                    raise AircraftError("JSBSim ended the flight")
        except AircraftError:
            raise
        except Exception as error:  # JSBSim's own, of many kinds
            raise AircraftError(f"JSBSim: {' '.join(str(error).split())[:400]}") from None

    def close(self) -> None:
        """Let JSBSim's instance go."""
        del self.fdm
