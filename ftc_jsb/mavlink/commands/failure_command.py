"""MAV_CMD_INJECT_FAILURE: gated, idempotent, and never more than the aircraft can have."""

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.disturbance.faults import CAPACITY
from ftc_jsb.mavlink.commands.command_handlers import (
    Acknowledgement,
    CommandHandlers,
    Handlers,
    Params,
    Result,
    whole_number,
)
from ftc_jsb.mavlink.commands.failure_faults import SENSORS, Failure, faults_of_failure
from ftc_jsb.mavlink.commands.vehicle_access import VehicleAccess
from ftc_jsb.recording.commands import SetFaults
from ftc_jsb.simulation.assembly import point_mass_of


class FailureCommand(CommandHandlers):
    """Failures by command."""

    def __init__(self, vehicle: VehicleAccess) -> None:
        """Args: the vehicle that is commanded."""
        super().__init__(vehicle)
        self._engines = point_mass_of(vehicle.scenario).thrust.engines
        self._injected: dict[tuple[str, ...], SetFaults] = {}

    def handlers(self) -> Handlers:
        """By MAV_CMD."""
        return {dialect.MAV_CMD_INJECT_FAILURE: self._inject_failure}

    def restart(self) -> None:
        """A flight begins anew, with the scenario's faults alone."""
        self._injected.clear()

    def _inject_failure(self, params: Params) -> Acknowledgement:
        if self._vehicle.parameters["SYS_FAILURE_EN"] != 1.0:
            return Acknowledgement(Result.DENIED, "refused: SYS_FAILURE_EN is 0")
        unit, kind, instance = (whole_number(value) for value in params[:3])
        failure = Failure(
            unit,
            kind,
            instance,
            effectiveness=self._vehicle.parameters["FAIL_EFF"],
            delay=self._vehicle.parameters["FAIL_DELAY"],
        )
        command = faults_of_failure(self._vehicle.scenario, self._engines, failure)
        if command is None:
            return Acknowledgement(Result.UNSUPPORTED, "refused: this aircraft has no such failure")
        if self._injected.get(command.targets) == command:
            return Acknowledgement(Result.ACCEPTED)  # sent again: it is there already
        others = {t: c for t, c in self._injected.items() if not {*t} & {*command.targets}}
        count = len(self._vehicle.scenario.fault) + sum(len(c.faults) for c in others.values())
        if count + len(command.faults) > CAPACITY:
            return Acknowledgement(Result.DENIED, "refused: too many faults at once")
        ack = self._queue(lambda: command, _sensor_text(command, unit))
        if ack.result == Result.ACCEPTED:
            self._injected = {**others, command.targets: command}
        return ack


def _sensor_text(command: SetFaults, unit: int) -> str:
    """What a failure of a sensor is; others are events of the recording."""
    if unit not in SENSORS:
        return ""
    if not command.faults:
        return f"fault removed: {command.targets[0]}"
    return f"fault injected: {command.faults[0].target} {command.faults[0].kind}"
