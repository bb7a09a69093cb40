"""The outer loop on a `jsbsim.FGFDMExec` of the user's own: see docs/plugin.md for an example."""

import math
from typing import Any

import numpy as np

from ftc_jsb.aircraft.description import Aircraft, load_aircraft
from ftc_jsb.aircraft.point_mass_file import PointMass, load_point_mass
from ftc_jsb.compiled import direct
from ftc_jsb.control.altitude_hold import altitude_hold
from ftc_jsb.control.command_filter import command_filter
from ftc_jsb.control.protocol import LoopSetup
from ftc_jsb.disturbance.faults import fault_records, schedule
from ftc_jsb.disturbance.sensors import Instruments, sensor_record
from ftc_jsb.errors import LoopError
from ftc_jsb.loops.registry import RecordedLoop, build_loop
from ftc_jsb.plugin.checks import check_aircraft, steps_per_sample
from ftc_jsb.recording.columns import ROW, numbers
from ftc_jsb.resources import aircraft_folder
from ftc_jsb.scenario.loop import Loop
from ftc_jsb.scenario.reference import Reference, climb_of, filter_lag, raw_commands
from ftc_jsb.scenario.schema import AircraftChoice, Initial
from ftc_jsb.scenario.sensors import Sensors
from ftc_jsb.simulation.assembly import OUTPUTS
from ftc_jsb.simulation.departure import FLYING, REASONS, departed
from ftc_jsb.simulation.sample import LoopInputs, perceive
from ftc_jsb.six_dof.engines import engine_count
from ftc_jsb.six_dof.plant import JsbsimPlant
from ftc_jsb.six_dof.point_mass_match import check_point_mass
from ftc_jsb.six_dof.properties import readers, writer
from ftc_jsb.six_dof.weaving.engine_deck import EFFECTIVENESS
from ftc_jsb.units import POUND_MASS

AT_REST = Reference(airspeed=((0.0, 100.0),), altitude=((0.0, 1000.0),), heading_deg=((0.0, 0.0),))


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
        check_aircraft(fdm, loaded)
        self._fdm = fdm
        self._rate = settings.rate
        self._dt = fdm.get_delta_t()
        self._steps = steps_per_sample(self._dt, settings.rate)
        self._start = fdm.get_sim_time()
        self._samples = 0
        self._reference = reference
        self._record = np.full(3, math.nan).astype(ROW)  # the first sample, another, the one after
        self._attach(loaded)
        self._observe(0)
        self._refuse_departed(departed(self._record, 0))
        self._targets = [float(self._record[0][name]) for name in OUTPUTS] + [math.nan]
        point_mass = load_point_mass(aircraft_folder(aircraft))
        check_point_mass(fdm, loaded, point_mass)
        self._loop = self._built_loop(point_mass, settings, mass)
        self._inputs = self._at_rest()
        self._perceive = direct(perceive, self._inputs, 0)
        writer(fdm, "ftc/engaged")(1.0)

    def _attach(self, aircraft: Aircraft) -> None:
        """Bind the readers and writers of the woven aircraft to the recording."""
        fdm, engines = self._fdm, engine_count(self._fdm)
        schedule(fault_records(()), engines, self._record)
        self._plant = JsbsimPlant(AircraftChoice(), _here(fdm), 1.0 / self._rate, self._steps)
        self._plant.attach(fdm, aircraft, self._record)
        names = [f"{EFFECTIVENESS}[{number}]" for number in range(engines)]
        self._effectiveness = readers(fdm, names)

    def _built_loop(self, aircraft: PointMass, settings: Loop, mass: float | None) -> RecordedLoop:
        model = aircraft.record(0.0)
        now = self._fdm["inertia/weight-lbs"] * POUND_MASS
        model[0]["mass"] = model[0]["mass_start"] = now if mass is None else mass
        setup = LoopSetup(aircraft, float(model[0]["mass"]), settings, 1.0 / settings.rate)
        return build_loop(setup, model, self._record)

    def _at_rest(self) -> LoopInputs:
        """Perfect instruments, and the command filter at rest on the first commands."""
        record = self._record
        reference = self._reference or AT_REST
        shape = reference.filter_frequency, reference.filter_damping
        position = [float(record[0][axis]) for axis in ("north", "east", "altitude")]
        filters = command_filter(*shape, 1.0 / self._rate, self._raw(0)[:3], position)
        hold = altitude_hold(*climb_of(reference), filter_lag(reference))
        sensors = sensor_record(Sensors(), 0, record)
        instruments = Instruments(sensors, fault_records(()), record, numbers(record))
        return LoopInputs(instruments, filters, hold)

    def track(
        self,
        airspeed: float | None = None,
        flight_path_angle: float | None = None,
        heading: float | None = None,
        altitude: float | None = None,
    ) -> None:
        """New set-points [m/s], [rad], [rad], [m], from the next sample on; None leaves one as it is.

        They pass through the command filter (3 rad/s, or that of `reference`), so that they may
        be steps, or new at every sample. An altitude above sea level is reached and held until a
        flight path angle is given, at 5 deg or the path of `reference`.

        Raises:
            LoopError: one is not finite, or the references are those of a scenario.
        """
        if self._reference is not None:
            raise LoopError("track: the references are those of the scenario this loop was given")
        if flight_path_angle is not None and altitude is not None:
            raise LoopError("track: flight_path_angle and altitude given; expected one of them")
        given = (airspeed, flight_path_angle, heading, altitude)
        for k, (name, value) in enumerate(zip((*OUTPUTS, "altitude"), given, strict=True)):
            if value is not None:
                if not math.isfinite(value):
                    raise LoopError(f"track: {name} is {value!r}, expected a finite number")
                self._targets[k] = float(value)
        if flight_path_angle is not None:
            self._targets[3] = math.nan

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
        made = float(self._record[min(self._samples, 2)]["flight_path_angle_cmd_raw"])
        for k, row in enumerate((now, after)):
            row["time"] = (self._samples + k) / self._rate
            commands = self._raw(self._samples + k)
            for name, value in zip((*OUTPUTS, "altitude"), commands, strict=True):
                row[f"{name}_cmd_raw"] = value
        if self._inputs.altitude_hold[0]["active"]:
            now["flight_path_angle_cmd_raw"] = made
        self._observe(i)
        self._refuse_departed(self._perceive(self._inputs, i))
        self._loop.step(i)
        self._plant.command(i)

    def _observe(self, i: int) -> None:
        self._plant.truth(i)
        truth = sum(read() for read in self._effectiveness) / len(self._effectiveness)
        self._record[i]["effectiveness_thrust"] = truth  # for the loop `oracle` alone

    def _refuse_departed(self, reason: int) -> None:
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


def _here(fdm: Any) -> Initial:
    """Where the aircraft is: origin of the tangent plane, and the turn that headings count from."""
    heading = math.degrees(fdm["attitude/psi-rad"])
    return Initial.model_construct(  # not checked: it is what it is
        heading_deg=heading - 360.0 if heading > 359.0 else heading,  # north is 0, not 360
        latitude_deg=fdm["position/lat-geod-deg"],
        longitude_deg=fdm["position/long-gc-deg"],
    )
