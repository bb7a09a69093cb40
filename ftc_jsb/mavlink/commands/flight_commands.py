"""Commands over the course of a flight: pause, resume, end, reset, shutdown; arming."""

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.commands.acknowledgement import (
    ACCEPTED,
    DENIED,
    REJECTED,
    UNSUPPORTED,
    Handlers,
    Params,
    Reply,
    given,
    whole,
)
from ftc_jsb.mavlink.commands.vehicle_access import Desk
from ftc_jsb.mavlink.telemetry.snapshot import Phase
from ftc_jsb.mavlink.telemetry.status import IN_THE_AIR
from ftc_jsb.recording.commands import End, Pause, Reset, Resume

REBOOT, SHUTDOWN = 1, 2  # parameter 1 of PREFLIGHT_REBOOT_SHUTDOWN


class CourseCommands:
    """How a flight goes on, or does not."""

    def __init__(self, desk: Desk) -> None:
        """Args: the vehicle."""
        self._desk = desk
        self.handlers: Handlers = {
            dialect.MAV_CMD_DO_PAUSE_CONTINUE: self._pause_continue,
            dialect.MAV_CMD_DO_FLIGHTTERMINATION: self._terminate,
            dialect.MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN: self._reboot_shutdown,
            dialect.MAV_CMD_COMPONENT_ARM_DISARM: self._arm_disarm,
        }

    def _pause_continue(self, params: Params) -> Reply:
        paused = self._desk.snapshot().phase is Phase.PAUSED
        if params[0] == 0.0:
            return Reply(ACCEPTED) if paused else given(self._desk, Pause, "paused")
        if params[0] == 1.0:
            return given(self._desk, Resume, "resumed") if paused else Reply(ACCEPTED)
        return Reply(DENIED)

    def _terminate(self, params: Params) -> Reply:
        if not params[0] > 0.5:
            return Reply(DENIED, "refused: a flight that has ended stays so")
        if self._desk.snapshot().phase not in IN_THE_AIR:
            return Reply(ACCEPTED)
        return given(self._desk, End, "ended by command")

    def _reboot_shutdown(self, params: Params) -> Reply:
        action = whole(params[0])
        if action == REBOOT:
            self._desk.give(Reset())
            return Reply(ACCEPTED, "reset: the scenario begins anew")
        if action == SHUTDOWN:
            self._desk.leaves = True
            self._desk.give(End())
            return Reply(ACCEPTED, "ended by command, the link closes")
        return Reply(UNSUPPORTED)

    def _arm_disarm(self, params: Params) -> Reply:
        if self._desk.snapshot().phase in IN_THE_AIR:
            return Reply(REJECTED, "refused: it is in the air and stays armed")
        return Reply(REJECTED, "refused: reboot begins a flight")
