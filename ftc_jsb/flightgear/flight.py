"""One flight of an aircraft that another program flies: its lines become rows, its rows become commands."""

import math
import time
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from ftc_jsb.errors import ScenarioError, UserError
from ftc_jsb.flightgear.exchange import Exchange, Received
from ftc_jsb.flightgear.measured_step import MeasuredStep
from ftc_jsb.flightgear.outside_aircraft import (
    FLYING_OUTER_LOOP,
    Numbers,
    OutsideAircraft,
)
from ftc_jsb.flightgear.references import Pilot, References, Triple
from ftc_jsb.flightgear.timing import Arrival
from ftc_jsb.interruption import interruptible
from ftc_jsb.loops.fence import fenced
from ftc_jsb.recording.commands import Applied, Reset
from ftc_jsb.recording.flight import Flight, Outcome
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.admissible_faults import refuse_unflyable
from ftc_jsb.simulation.advance import Observer
from ftc_jsb.simulation.assembly import OUTPUTS, assemble, blank_recording
from ftc_jsb.simulation.command_source import CommandSource
from ftc_jsb.simulation.departure import FLYING, REASONS
from ftc_jsb.simulation.steering import RAW, Steering
from ftc_jsb.six_dof.exchange.fields import FAULTS

SILENCE = 30.0  # [s] of the clock without a line that end a flight
WAKE = 0.1  # [s] of the clock between looks at what else there is
GONE = 5  # times that the loop says that it leaves
SHOWN = (
    "thrust_cmd",
    "load_factor_cmd",
    "bank_angle_cmd",
    "airspeed_ref",
    "flight_path_angle_ref",
    "heading_ref",
    "effectiveness_thrust_est",
    "effectiveness_thrust_std",
    "fault_declared",
    "suspect",
    "suspect_probability",
)
Notify = Callable[[str], None]


class Delays(NamedTuple):
    """Simulation time from the frame of a line to the frame at which its command was in force [s]."""

    median: float
    p99: float
    most: float


class OutsideFlight:
    """A flight in another program, from its first line on."""

    def __init__(
        self, scenario: Scenario, exchange: Exchange, origin: Numbers, notify: Notify
    ) -> None:
        """What the flight is made of; nothing is commanded yet.

        Args:
            scenario: its [initial] is where the aircraft is (`started_where_it_is`).
            exchange: with the simulator.
            origin: line of that moment.
            notify: told what happens, in a sentence.

        Raises:
            UserError: aircraft or loop cannot be had, or the scenario asks for what this model has not.
        """
        refuse_unflyable(scenario)
        refuse_what_is_the_simulators(scenario)
        self._scenario, self._exchange, self._notify = scenario, exchange, notify
        self._value = exchange.fields.value
        aircraft = OutsideAircraft(exchange.fields, origin, scenario.initial)
        self._aircraft = aircraft
        engines = exchange.fields.engines
        self._plan = blank_recording(scenario, engines)  # what is to be flown, at even times
        flown = assemble(scenario, aircraft, record=blank_recording(scenario, engines))
        self.record = flown.record
        self.steering = Steering(scenario, flown._replace(record=self._plan))
        self._loop = MeasuredStep(flown, scenario.reference)
        self._references = References()
        self._rows = 0
        self._start = self._time = 0.0
        self._flying: bool | None = None
        self._delays: list[float] = []
        self._answered = 0
        self._impulse = 0.0  # of the last line [N s]
        self._faults: dict[str, float] = {}  # of the last command

    @property
    def delays(self) -> Delays | None:
        """Measured so far; None before the first command was in force."""
        if not self._delays:
            return None
        median, p99 = np.percentile(self._delays, [50.0, 99.0])
        return Delays(float(median), float(p99), max(self._delays))

    def fly(
        self, observers: Sequence[Observer] = (), commands: CommandSource | None = None
    ) -> Flight:
        """Fly until the scenario is over, or the flight ends for another reason."""
        started = time.perf_counter()
        with fenced():
            outcome = self._flown(observers, commands)
            self._leave()
        elapsed = time.perf_counter() - started
        applied = tuple(self.steering.applied)
        if outcome.reason == RESET:
            applied = (*applied, Applied(max(self._rows, 1), Reset()))
        rows = max(self._rows, 1)
        return Flight(self._scenario, self.record[:rows], outcome, self._time / elapsed, applied)

    def _flown(self, observers: Sequence[Observer], commands: CommandSource | None) -> Outcome:
        least = 0.999 / self._scenario.loop.rate
        try:
            with interruptible():
                while True:
                    answer: Received | None = None
                    came = self._exchange.receive(WAKE, least)
                    if not came:  # asked after what waits is read: the first sample may have compiled for long
                        self._exchange.check_alive(SILENCE)
                    for received in came:
                        outcome = self._sample(received, observers, commands)
                        if outcome is not None:
                            return outcome
                        answer = received
                    if answer is not None:  # of several that came together the last is answered
                        self._command(answer.moment.frame)
        except UserError as error:
            return Outcome("failed", self._time, str(error))
        except KeyboardInterrupt:
            return Outcome("interrupted", self._time, "interrupted")

    def _sample(
        self, received: Received, observers: Sequence[Observer], commands: CommandSource | None
    ) -> Outcome | None:
        """One line; an outcome if the flight ends with it."""
        if received.arrival is Arrival.RESET:
            return Outcome("ended", self._time, RESET)
        i, now = self._rows, received.moment.time
        if i == 0:
            self._start = now
        step = now - self._start - self._time if i else 1.0 / self._scenario.loop.rate
        t = now - self._start
        if t > self._scenario.duration + 1e-9 or i >= self.record.size:
            return Outcome("complete", self._scenario.duration, "")
        self._time = t
        place = min(int(t * self._scenario.loop.rate + 1e-6), self._plan.size - 2)
        goes_on = True
        if commands is not None and i > 0:
            goes_on = self.steering.apply_all(commands.take(place + 1), place + 1)
        if not goes_on:
            return Outcome("ended", t, "ended by command")
        self.steering.reach(place + 2)
        reason = self._decide(i, received.numbers, t, step, place)
        self._rows = i + 1
        if reason != FLYING:
            return Outcome("departed", t, REASONS[reason])
        self._faults = {name: _finite(self._plan[place][name], 1.0) for name in FAULTS}
        for observe in observers:
            observe(self.record, i)
        return None

    def _decide(self, i: int, line: Numbers, t: float, step: float, place: int) -> int:
        """Row `i` from a line: truth, references, and what the loop makes of them."""
        record = self.record
        self._aircraft.read(line)
        record["time"][i] = t
        record["time"][i + 1 : i + 2] = t + step  # a guess, until the line comes
        self._aircraft.truth(i)
        planned, altitude = self._planned(t)
        raw = self._raw(i, line, planned, step)
        for name, value in zip(RAW, (*raw, altitude), strict=True):
            record[name][i : i + 2] = value
        self._loop.in_force(*self._in_force(line, step))
        self._measure_delay(line)
        reason = self._loop.sample(i, step, self.steering.setup)
        if i == 0:
            self._loop.start_engine(self._value(line, "thrust_in_force"))
        return reason

    def _in_force(self, line: Numbers, step: float) -> Triple:
        """Thrust [N] on the average of the step that has passed, load factor and bank [rad] at its end."""
        impulse = self._value(line, "impulse")
        thrust = self._value(line, "thrust_in_force")
        if self._rows > 0:
            thrust = (impulse - self._impulse) / step
        self._impulse = impulse
        return (
            thrust,
            self._value(line, "load_factor_in_force"),
            self._value(line, "bank_angle_in_force"),
        )

    def _planned(self, t: float) -> tuple[Triple, float]:
        """Commands of the scenario and the ground station at a time [s]; altitude nan if none is commanded."""
        times = self._plan["time"]
        a, b, c = (float(np.interp(t, times, self._plan[name])) for name in RAW[:3])
        return (a, b, c), float(self._plan[RAW[3]][np.searchsorted(times, t, "right") - 1])

    def _raw(self, i: int, line: Numbers, planned: Triple, step: float) -> Triple:
        """Raw commands; those of an aircraft that the loop does not fly are what is flown."""
        flies = self._value(line, "flying") == FLYING_OUTER_LOOP
        if flies != self._flying:
            self._announce(flies)
        self._flying = flies
        if i == 0 or not flies:
            row = self.record[i]
            flown = (float(row[OUTPUTS[0]]), float(row[OUTPUTS[1]]), float(row[OUTPUTS[2]]))
            self._references.begin_at(flown, planned)
            self._loop.start_references(
                flown, [float(row[n]) for n in ("north", "east", "altitude")]
            )
            return flown
        pilot = Pilot(
            self._value(line, "pilot") > 0.5,
            *(self._value(line, f"pilot_{name}") for name in ("airspeed", "path", "bank")),
        )
        before = self._references.piloted
        raw = self._references.raw(planned, pilot, step)
        if pilot.has != before:
            self._notify(
                "the pilot moves the references"
                if pilot.has
                else "references of the scenario again"
            )
        return raw

    def _announce(self, flies: bool) -> None:
        if flies:
            self._notify("the outer loop flies")
        elif self._flying is not None:
            self._notify("inner loop alone: wings level, speed held")

    def _measure_delay(self, line: Numbers) -> None:
        answered = round(self._value(line, "answered"))
        if answered > self._answered:
            if self._answered:
                frames = self._value(line, "accepted_frame") - answered
                self._delays.append(frames * self._value(line, "frame_time"))
            self._answered = answered

    def _command(self, frame: int) -> None:
        values = {name: _finite(self.record[self._rows - 1][name], 0.0) for name in SHOWN}
        values["delay"] = self._delays[-1] if self._delays else 0.0
        self._exchange.command({**values, **self._faults, "frame": frame, "flies": 1.0})

    def _leave(self) -> None:
        """Say that the loop leaves, so that the inner loop takes over at once: once a line that comes."""
        if not self._faults:
            return
        values = {**dict.fromkeys((*SHOWN, "delay"), 0.0), **self._faults}
        for _ in range(GONE):
            for received in self._exchange.receive(WAKE, 0.0):
                self._exchange.command({**values, "frame": received.moment.frame, "flies": 0.0})


RESET = "the simulator was reset"


def _finite(value: Any, otherwise: float) -> float:
    return float(value) if math.isfinite(value) else otherwise


def refuse_what_is_the_simulators(scenario: Scenario) -> None:
    """See that a scenario asks for nothing that the simulator alone decides, or that needs even samples.

    Raises:
        ScenarioError: it does; names the key.
    """
    from ftc_jsb.scenario.sensors import Sensors
    from ftc_jsb.scenario.wind import Wind

    if scenario.wind != Wind():
        raise ScenarioError("wind: the simulator has its own weather; set it there")
    if scenario.sensors != Sensors():
        raise ScenarioError("sensors: a flight in another program has perfect ones")
