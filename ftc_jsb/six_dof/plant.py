"""The JSBSim aircraft as a plant: commands into the woven inner loop, the true state out."""

import math
import struct
from functools import partial
from operator import call
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from ftc_jsb.aircraft.description import Aircraft, load_aircraft
from ftc_jsb.aircraft.point_mass_file import PointMass
from ftc_jsb.compiled import direct
from ftc_jsb.disturbance.weather import wind_record
from ftc_jsb.disturbance.wind import wind_step
from ftc_jsb.errors import AircraftError
from ftc_jsb.recording.columns import numbers
from ftc_jsb.scenario.schema import AircraftChoice, Initial
from ftc_jsb.scenario.wind import Wind
from ftc_jsb.six_dof.air import set_turbulence, start_in_wind
from ftc_jsb.six_dof.engines import delivered_thrust, engine_count, thrust_property
from ftc_jsb.six_dof.fault_writers import FaultWriters
from ftc_jsb.six_dof.observation import (
    JSBSIM_STATE,
    POSITION_NAMES,
    PROPERTIES,
    observe,
    place_origin,
)
from ftc_jsb.six_dof.point_mass_match import check_point_mass
from ftc_jsb.six_dof.properties import readers, writer
from ftc_jsb.six_dof.sensor_errors import SensorErrors
from ftc_jsb.six_dof.trim import trimmed
from ftc_jsb.six_dof.weaving.faults import observed
from ftc_jsb.six_dof.weaving.woven_aircraft import woven_aircraft
from ftc_jsb.units import FOOT
from ftc_jsb.vocabulary.channels import SURFACES

COMMANDS = ("ftc/command/thrust-n", "ftc/command/load-factor", "ftc/command/bank-rad")
COMMANDED = ("thrust_cmd", "load_factor_cmd", "bank_angle_cmd")
WIND_AXES = ("north", "east", "down")


class JsbsimPlant:
    """A `Plant` on a woven JSBSim aircraft, one fresh FGFDMExec a flight."""

    def __init__(
        self,
        choice: AircraftChoice,
        initial: Initial,
        dt: float,
        steps: int,
        *,
        wind: Wind | None = None,
        seed: int = 0,
        measured: bool = False,
        point_mass: PointMass | None = None,
    ) -> None:
        """A plant that `reset` trims, or `attach` binds to an aircraft that flies.

        Args:
            choice: [aircraft] of a scenario.
            initial: [initial] of a scenario.
            dt: sample time [s].
            steps: JSBSim steps a sample.
            wind: [wind] of a scenario; default: still air.
            seed: of the wind.
            measured: the inner loop reads what the sensors measure; otherwise the truth.
            point_mass: that the outer loop counts on, to be seen that it is of this aircraft.
        """
        self._point_mass = point_mass
        self._choice = choice
        self._initial = initial
        self._steps = steps
        self._sample = dt
        self._air = wind or Wind()
        self._seed = seed
        self._measured = measured
        self._state = np.zeros(1, JSBSIM_STATE)

    def reset(self, record: npt.NDArray[Any]) -> None:
        """Weave, load, trim, check and engage; binds the recording to write to.

        Raises:
            AircraftError, TrimError: with the property or the residuals; or the point mass is another's.
        """
        aircraft = load_aircraft(self._choice.name)
        corrected = self._choice.flight_control == "corrected"
        root = woven_aircraft(aircraft, corrected, self._measured)
        frame = self._sample / self._steps
        fuel = self._choice.fuel_fraction
        fdm = trimmed(aircraft, root, frame, self._initial, fuel)
        if self._point_mass is not None:
            check_point_mass(fdm, aircraft, self._point_mass)
        self._wind = wind_record(self._air, self._initial.altitude, self._seed, dryden=False)
        self._blow = direct(wind_step, self._wind, record, 0, self._sample)
        set_turbulence(fdm, self._air, self._seed)
        self._windy = self._wind[0]["still"] == 0
        if self._windy:
            start_in_wind(fdm, self._wind[0]["steady"])
        self.attach(fdm, aircraft, record)
        self._winds = [writer(fdm, f"atmosphere/wind-{axis}-fps") for axis in WIND_AXES]
        engines = engine_count(fdm)
        self._faults = FaultWriters(fdm, engines, record, self._numbers)
        if self._measured:
            self._errors = SensorErrors(fdm, record, self._numbers, self._sample)
        level = math.cos(math.radians(self._initial.flight_path_deg))
        start = (delivered_thrust(fdm, engines), level, 0.0)
        for (write, _), value in zip(self._commands, start, strict=True):
            write(value)
        writer(fdm, "ftc/engaged")(1.0)

    def attach(self, fdm: Any, aircraft: Aircraft, record: npt.NDArray[Any]) -> None:
        """Bind to an instance that flies the woven aircraft, and to the recording to write to.

        Raises:
            AircraftError: a property is missing.
        """
        self.fdm = fdm
        self._record, self._numbers = record, numbers(record)
        engines = engine_count(fdm)
        names = [*PROPERTIES]
        names += [observed(aircraft, getattr(aircraft.positions, name)) for name in POSITION_NAMES]
        names += [thrust_property(number) for number in range(engines)]
        self._readers = readers(fdm, names)
        self._raw = np.zeros(len(names))
        self._pack = partial(struct.Struct(f"{len(names)}d").pack_into, cast(Any, self._raw), 0)
        command = [writer(fdm, name) for name in COMMANDS]
        columns = list(record.dtype.names or ())
        commanded = [columns.index(name) for name in COMMANDED]
        sent = readers(fdm, [getattr(aircraft.positions, name) for name in SURFACES])
        self._sent = [
            (read, columns.index(f"{name}_cmd")) for read, name in zip(sent, SURFACES, strict=True)
        ]
        self._commands = list(zip(command, commanded, strict=True))
        self._number = self._numbers.item
        seen = (self._raw, self._state, record)
        self._observe = partial(direct(observe, *seen, 0), *seen)
        self._place_origin(fdm)

    def _place_origin(self, fdm: Any) -> None:
        origin = [fdm[f"position/ecef-{axis}-ft"] * FOOT for axis in "xyz"]
        place_origin(self._state[0], self._initial, origin)

    def truth(self, i: int) -> None:
        """Write the state to row `i`."""
        self._pack(*map(call, self._readers))
        self._observe(i)
        for read, column in self._sent:
            self._numbers[i, column] = read()

    def command(self, i: int) -> None:
        """Give the inner loop the commands of row `i`."""
        for write, column in self._commands:
            write(self._number(i, column))

    def step(self, i: int) -> None:
        """Fly the commands of row `i` for one sample.

        Raises:
            AircraftError: JSBSim raised, or says that it is over.
        """
        self.command(i)
        self._faults.write(i)
        if self._measured:
            self._errors.write(i)
        if self._windy:
            self._blow(self._wind, self._record, i, self._sample)
            north, east, up = self._wind[0]["now"].tolist()
            for write, speed in zip(self._winds, (north, east, -up), strict=True):
                write(speed / FOOT)
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
