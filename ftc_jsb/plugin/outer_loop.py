"""The outer loop on a `jsbsim.FGFDMExec` of the user's own: see docs/plugin.md for an example."""

import math
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from ftc_jsb.aircraft.description import Aircraft, load_aircraft
from ftc_jsb.aircraft.point_mass_file import load_point_mass
from ftc_jsb.compiled import direct
from ftc_jsb.control.command_filter import command_filter, reference_step
from ftc_jsb.control.protocol import LoopSetup
from ftc_jsb.disturbance.faults import fault_records, schedule
from ftc_jsb.disturbance.sensors import Senses, measure, sensor_record
from ftc_jsb.errors import AircraftError, LoopError
from ftc_jsb.loops.registry import build_loop
from ftc_jsb.recording.columns import ROW, numbers
from ftc_jsb.resources import aircraft_folder
from ftc_jsb.scenario.loop import Loop
from ftc_jsb.scenario.reference import Reference, raw_commands
from ftc_jsb.scenario.schema import AircraftChoice, Initial, Scenario
from ftc_jsb.simulation.admissible_faults import SLOWEST_JSBSIM
from ftc_jsb.simulation.departure import FLYING, REASONS, departed
from ftc_jsb.six_dof.engines import engine_count
from ftc_jsb.six_dof.plant import JsbsimPlant
from ftc_jsb.six_dof.properties import readers, write_checked, writer
from ftc_jsb.six_dof.weaving.engine_deck import EFFECTIVENESS
from ftc_jsb.six_dof.weaving.woven_aircraft import woven_aircraft
from ftc_jsb.units import POUND_MASS

FlightControl = Literal["corrected", "stock"]
_STATES = ("airspeed", "flight_path_angle", "heading")


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


class OuterLoop:
    """An outer loop that flies the aircraft in a user's `FGFDMExec`, from the user's own trim on.

    It engages the inner loop when it is built and holds the airspeed, flight path and heading of
    that moment, until `track` or a `reference` says otherwise. `update` is to be called before
    every `fdm.run()`. SI and radians; heading is continuous, so 10 degrees seen from 350 are 370.
    """

    def __init__(
        self,
        fdm: Any,
        aircraft: str,
        settings: Loop | None = None,
        reference: Reference | None = None,
        mass: float | None = None,
    ) -> None:
        """Attach and engage.

        Args:
            fdm: flies the woven aircraft (`load_woven`), trimmed, with its engines running.
            aircraft: its name or folder, for what the loop may count on.
            settings: [loop] of a scenario: which loop, rate [Hz], gains, estimator. Default `ftc`,
                100 Hz. JSBSim's time step must divide the period.
            reference: [reference] of a scenario, its time starting now; default: hold.
            mass: that the loop counts on [kg]; default: the aircraft's now.

        Raises:
            AircraftError: no inner loop, another aircraft, an engine that does not run, a switch
                that is not set.
            LoopError: JSBSim's time step does not divide the loop's period, or is too long.
        """
        loaded = load_aircraft(aircraft)
        settings = settings or Loop()
        _check(fdm, loaded)
        self._fdm = fdm
        self._rate = settings.rate
        self._dt = fdm.get_delta_t()
        self._steps = _steps(self._dt, settings.rate)
        self._start = fdm.get_sim_time()
        self._samples = 0
        self._reference = reference
        self._record = np.full(3, math.nan).astype(ROW)  # the first sample, another, the one after
        schedule(fault_records(()), engine_count(fdm), self._record)
        self._plant = JsbsimPlant(AircraftChoice(), _here(fdm), 1.0 / settings.rate, self._steps)
        self._plant.attach(fdm, loaded, self._record)
        engines = [f"{EFFECTIVENESS}[{number}]" for number in range(engine_count(fdm))]
        self._effectiveness = readers(fdm, engines)
        self._departed = direct(departed, self._record, 0)
        self._senses = _perfect_senses(self._record)
        self._measure = direct(measure, *self._senses, 0)
        self._observe(0)
        point_mass = load_point_mass(aircraft_folder(aircraft))
        model = point_mass.record(0.0)
        model[0]["mass"] = fdm["inertia/weight-lbs"] * POUND_MASS if mass is None else mass
        period = 1.0 / settings.rate
        setup = LoopSetup(point_mass, float(model[0]["mass"]), settings, period)
        self._loop = build_loop(setup, model, self._record)
        self._targets = [float(self._record[0][name]) for name in _STATES]
        first = self._raw(0)
        shape = (reference.filter_frequency, reference.filter_damping) if reference else (3.0, 1.0)
        position = [float(self._record[0][axis]) for axis in ("north", "east", "altitude")]
        self._filters = command_filter(*shape, period, first, position)
        self._refer = direct(reference_step, self._filters, self._record, 0)
        writer(fdm, "ftc/engaged")(1.0)

    def track(
        self,
        airspeed: float | None = None,
        flight_path_angle: float | None = None,
        heading: float | None = None,
    ) -> None:
        """New set-points [m/s], [rad], [rad], from the next sample on; None leaves one as it is.

        They pass through the command filter (3 rad/s, or that of `reference`), so that they may
        be steps, or new at every sample.

        Raises:
            LoopError: one is not finite, or the references are those of a scenario.
        """
        if self._reference is not None:
            raise LoopError("track: the references are those of the scenario this loop was given")
        for k, value in enumerate((airspeed, flight_path_angle, heading)):
            if value is not None:
                if not math.isfinite(value):
                    raise LoopError(f"track: {_STATES[k]} is {value!r}, expected a finite number")
                self._targets[k] = float(value)

    def update(self) -> bool:
        """Take a sample of the outer loop where one is due; to be called before every `fdm.run()`.

        Returns:
            Whether one was taken.

        Raises:
            LoopError: a sample was missed, time or time step was changed, or the aircraft departed.
        """
        if self._fdm.get_delta_t() != self._dt:
            raise LoopError(
                f"time step: {self._fdm.get_delta_t():g} s; the loop was attached at {self._dt:g} s"
            )
        frame = round((self._fdm.get_sim_time() - self._start) / self._dt)
        due = self._samples * self._steps
        if frame > due or frame < due - self._steps:
            raise LoopError(
                f"time {self._fdm.get_sim_time():g} s: the next sample was due at "
                f"{self._start + due * self._dt:g} s; call update() before every run(), and attach "
                "a new OuterLoop after a reset"
            )
        if frame < due:
            return False
        self._sample(0 if self._samples == 0 else 1)
        self._samples += 1
        return True

    def _sample(self, i: int) -> None:
        now, after = self._record[i], self._record[i + 1]
        for k, row in enumerate((now, after)):
            row["time"] = (self._samples + k) / self._rate
            for name, value in zip(_STATES, self._raw(self._samples + k), strict=True):
                row[f"{name}_cmd_raw"] = value
        self._observe(i)
        self._measure(*self._senses, i)
        self._refer(self._filters, self._record, i)
        self._loop.step(i)
        self._plant.command(i)

    def _observe(self, i: int) -> None:
        self._plant.truth(i)
        truth = sum(read() for read in self._effectiveness) / len(self._effectiveness)
        self._record[i]["effectiveness_thrust"] = truth  # for the loop `oracle` alone
        reason = self._departed(self._record, i)
        if reason != FLYING:
            raise LoopError(f"departed at {self._fdm.get_sim_time():.2f} s: {REASONS[reason]}")

    def _raw(self, sample: int) -> list[float]:
        """Commands before the filter at a sample."""
        if self._reference is None:
            return self._targets
        return list(raw_commands(self._reference, np.array([sample / self._rate]))[0])

    def __getitem__(self, name: str) -> float:
        """Any variable of the recording (docs/scenarios.md) at the last sample; nan before it.

        Raises:
            KeyError: there is none of that name.
        """
        if name not in (ROW.names or ()):
            raise KeyError(name)
        return float(self._record[0 if self._samples <= 1 else 1][name])

    @property
    def effectiveness(self) -> float:
        """Estimated effectiveness of thrust; 1 = healthy."""
        return self["effectiveness_thrust_est"]

    @property
    def effectiveness_std(self) -> float:
        """Its standard deviation, as the filter believes."""
        return self["effectiveness_thrust_std"]

    @property
    def fault_declared(self) -> bool:
        """Whether the detector declares a loss of thrust."""
        return self["fault_declared"] == 1.0


def _check(fdm: Any, aircraft: Aircraft) -> None:
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


def _steps(dt: float, rate: float) -> int:
    """JSBSim steps a sample."""
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


def _perfect_senses(record: npt.NDArray[Any]) -> Senses:
    still = Reference(
        airspeed=((0.0, 300.0),), flight_path_deg=((0.0, 0.0),), heading_deg=((0.0, 0.0),)
    )
    perfect = sensor_record(Scenario(name="plug-in", reference=still), record)
    return Senses(perfect, fault_records(()), record, numbers(record))


def _here(fdm: Any) -> Initial:
    """Where the aircraft is: origin of the tangent plane, and the turn that headings count from."""
    heading = math.degrees(fdm["attitude/psi-rad"])
    return Initial.model_construct(  # not checked: it is what it is
        heading_deg=heading - 360.0 if heading > 359.0 else heading,  # north is 0, not 360
        latitude_deg=fdm["position/lat-geod-deg"],
        longitude_deg=fdm["position/long-gc-deg"],
    )
