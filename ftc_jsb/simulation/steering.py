"""Commands applied to a flight: the rows to come are rewritten, the loop's settings replaced."""

import math
from collections.abc import Iterable

from pydantic import ValidationError

from ftc_jsb.control.protocol import LoopSetup
from ftc_jsb.disturbance.faults import CAPACITY, FIRST_SENSOR, TARGETS, fault_records, schedule
from ftc_jsb.errors import ScenarioError
from ftc_jsb.loops.built_in import BUILT_IN, CompiledLoop, loop_settings
from ftc_jsb.recording.commands import (
    Applied,
    ChangeScenario,
    Command,
    End,
    Reset,
    SetAirspeed,
    SetAltitude,
    SetFaults,
    SetFlightPath,
    SetHeading,
    SetLoop,
)
from ftc_jsb.scenario.faults import Fault
from ftc_jsb.scenario.keys import value_at, with_value
from ftc_jsb.scenario.loop import Loop
from ftc_jsb.scenario.reference import Reference, raw_commands
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.admissible_faults import impossible
from ftc_jsb.simulation.assembly import Assembly
from ftc_jsb.simulation.changed_scenario import changed_scenario
from ftc_jsb.simulation.rows_ahead import RowsAhead
from ftc_jsb.simulation.set_points import nearest_turn, ramp
from ftc_jsb.typed_file import first_problem

RAW = ("airspeed_cmd_raw", "flight_path_angle_cmd_raw", "heading_cmd_raw", "altitude_cmd_raw")


class Steering:
    """Applies commands to a flight that is being flown, and keeps what was applied."""

    def __init__(self, scenario: Scenario, flown: Assembly) -> None:
        """Args: the scenario that is flown, and what its flight is made of."""
        self._scenario = scenario
        self._setup = flown.setup
        self._model = flown.model
        self._loop = flown.loop
        self._instruments = flown.inputs.instruments
        self._hold = flown.inputs.altitude_hold
        self._record = flown.record
        self._faults = scenario.fault
        self._ahead = RowsAhead(flown.record.size)
        self.applied: list[Applied] = []

    def reach(self, beyond: int) -> None:
        """Have what commands have changed written in every row that flying up to row `beyond` reads."""
        self._ahead.reach(beyond)

    @property
    def setup(self) -> LoopSetup:
        """What the loop is built from, settings as they are now."""
        return self._setup

    def apply_all(self, commands: Iterable[Command], row: int) -> bool:
        """Apply commands before `row` is flown, as `apply`; whether the flight goes on."""
        return all(self.apply(command, row) for command in commands)

    def apply(self, command: Command, row: int) -> bool:
        """Apply `command` before `row` (1 or later) is flown.

        Returns:
            Whether the flight goes on.

        Raises:
            ScenarioError: the loop has no such setting, the value is out of its range, or the aircraft
                cannot have the fault.
        """
        if isinstance(command, SetLoop):
            self._set_loop(command)
        elif isinstance(command, SetFaults):
            self._set_faults(command, row)
        elif isinstance(command, SetAirspeed | SetFlightPath | SetHeading):
            self._set_point(command, row)
        elif isinstance(command, SetAltitude):
            self._set_altitude(command, row)
        elif isinstance(command, ChangeScenario):
            self._change(command, row)
        self.applied.append(Applied(row, command))
        return not isinstance(command, End | Reset)

    def _set_loop(self, command: SetLoop) -> None:
        self._use_loop(changed_loop(self._setup.settings, command))

    def _use_loop(self, loop: Loop) -> None:
        self._setup = self._setup._replace(settings=loop)
        if isinstance(self._loop, CompiledLoop):
            self._loop.arrays.settings[:] = loop_settings(self._setup, self._model)

    def _set_faults(self, command: SetFaults, row: int) -> None:
        for fault in command.faults:
            reason = impossible(self._scenario, fault)
            if reason:
                raise ScenarioError(f"set-faults: {reason}")
        now = {"start": float(self._record[row]["time"])}
        faults = [fault for fault in self._faults if fault.target not in command.targets]
        faults += [fault.model_copy(update=now) for fault in command.faults]
        if len(faults) > CAPACITY:
            raise ScenarioError(
                f"set-faults: {len(faults)} faults at once; expected {CAPACITY} at most"
            )
        self._use_faults(tuple(faults), row)

    def _use_faults(self, faults: tuple[Fault, ...], row: int) -> None:
        self._faults = faults
        records = fault_records(faults)
        self._instruments.faults[:] = records
        if any(TARGETS.index(fault.target) >= FIRST_SENSOR for fault in faults):
            self._instruments.sensors[0]["perfect"] = 0
        engines, record = self._setup.aircraft.thrust.engines, self._record

        def write(first: int, beyond: int) -> None:
            schedule(records, engines, record[:beyond], first)

        self._ahead.rewrite("faults", row, write)

    def _change(self, command: ChangeScenario, row: int) -> None:
        """What the overrides do not change stays, commands of the flight before included."""
        before = self._scenario
        changed = changed_scenario(before, command.overrides)
        if changed.reference != before.reference:
            self._use_reference(changed.reference, row)
        if changed.fault != before.fault:
            self._use_faults(changed.fault, row)
        if changed.loop != before.loop:
            self._use_loop(changed.loop)
        self._scenario = changed

    def _use_reference(self, reference: Reference, row: int) -> None:
        for column, name in enumerate(RAW):

            def write(first: int, beyond: int, column: int = column, name: str = name) -> None:
                rows = self._record[first:beyond]
                rows[name] = raw_commands(reference, rows["time"])[:, column]

            self._ahead.rewrite(name, row, write)

    def _set_point(self, command: SetAirspeed | SetFlightPath | SetHeading, row: int) -> None:
        column = {
            "set-airspeed": "airspeed_cmd_raw",
            "set-flight-path": "flight_path_angle_cmd_raw",
            "set-heading": "heading_cmd_raw",
        }[command.kind]
        before = self._record[row - 1]
        start, since = float(before[column]), float(before["time"])
        if isinstance(command, SetFlightPath):
            self._hold_value("altitude_cmd_raw", row, math.nan)
        target = command.value
        if isinstance(command, SetHeading):
            target = nearest_turn(target, start)

        def write(first: int, beyond: int) -> None:
            rows = self._record[first:beyond]
            rows[column] = ramp(start, target, command.rate, rows["time"] - since)

        self._ahead.rewrite(column, row, write)

    def _set_altitude(self, command: SetAltitude, row: int) -> None:
        self._hold[0]["steepest"] = command.flight_path
        self._hold[0]["path_rate"] = command.rate
        self._hold_value("altitude_cmd_raw", row, command.value)

    def _hold_value(self, column: str, row: int, value: float) -> None:
        def write(first: int, beyond: int) -> None:
            self._record[column][first:beyond] = value

        self._ahead.rewrite(column, row, write)


def changed_loop(loop: Loop, command: SetLoop) -> Loop:
    """[loop] with one number changed.

    Raises:
        ScenarioError: there is no such number, or the value is out of its range.
    """
    values = loop.model_dump()
    if loop.name not in BUILT_IN or type(value_at(values, command.key)) is not float:
        raise ScenarioError(f"loop.{command.key}: the loop {loop.name!r} has no such number")
    try:
        return Loop.model_validate(with_value(values, command.key, command.value))
    except ValidationError as error:
        raise ScenarioError(f"loop.{first_problem(error, Loop)}") from None
