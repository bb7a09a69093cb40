"""MAV_CMD_INJECT_FAILURE: gated, idempotent, and never more than the aircraft can have."""

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.disturbance.faults import CAPACITY
from ftc_jsb.mavlink.commands.acknowledgement import (
    ACCEPTED,
    DENIED,
    UNSUPPORTED,
    Handlers,
    Params,
    Reply,
    given,
    whole,
)
from ftc_jsb.mavlink.commands.failures import SENSORS, failure
from ftc_jsb.mavlink.commands.vehicle_access import Desk
from ftc_jsb.recording.commands import SetFaults
from ftc_jsb.simulation.assembly import point_mass_of


class FailureCommand:
    """Failures by command."""

    def __init__(self, desk: Desk) -> None:
        """Args: the vehicle."""
        self._desk = desk
        self._engines = point_mass_of(desk.scenario).thrust.engines
        self._injected: dict[tuple[str, ...], SetFaults] = {}
        self.handlers: Handlers = {dialect.MAV_CMD_INJECT_FAILURE: self._inject_failure}

    def restart(self) -> None:
        """A flight begins anew, with the scenario's faults alone."""
        self._injected.clear()

    def _inject_failure(self, params: Params) -> Reply:
        if self._desk.parameters["SYS_FAILURE_EN"] != 1.0:
            return Reply(DENIED, "refused: SYS_FAILURE_EN is 0")
        unit, kind, instance = (whole(value) for value in params[:3])
        numbers = (self._desk.parameters["FAIL_EFF"], self._desk.parameters["FAIL_DELAY"])
        command = failure(self._desk.scenario, self._engines, unit, kind, instance, *numbers)
        if command is None:
            return Reply(UNSUPPORTED, "refused: this aircraft has no such failure")
        if self._injected.get(command.targets) == command:
            return Reply(ACCEPTED)  # sent again: it is there already
        others = {t: given for t, given in self._injected.items() if not {*t} & {*command.targets}}
        count = len(self._desk.scenario.fault) + sum(len(c.faults) for c in others.values())
        if count + len(command.faults) > CAPACITY:
            return Reply(DENIED, "refused: too many faults at once")
        reply = given(self._desk, lambda: command, _told(command, unit))
        if reply.result == ACCEPTED:
            self._injected = {**others, command.targets: command}
        return reply


def _told(command: SetFaults, unit: int) -> str:
    """What a failure of a sensor is; others are seen in the recording."""
    if unit not in SENSORS:
        return ""
    if not command.faults:
        return f"fault removed: {command.targets[0]}"
    return f"fault injected: {command.faults[0].target} {command.faults[0].kind}"
