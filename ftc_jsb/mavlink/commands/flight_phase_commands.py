"""Commands that change the phase of a flight: pause, resume, end, reset, shutdown; arming."""

import math
import time

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.commands.command_handlers import (
    Acknowledgement,
    CommandHandlers,
    Handlers,
    Params,
    Result,
    whole_number,
)
from ftc_jsb.mavlink.commands.vehicle_access import VehicleAccess
from ftc_jsb.mavlink.telemetry.snapshot import Phase
from ftc_jsb.recording.commands import End, Pause, Reset, Resume

RESET_INTERVAL = 2.0  # [s] between two resets: each saves a flight
MOST_RESETS = 100  # of one run of the program
REBOOT, SHUTDOWN = 1, 2  # parameter 1 of PREFLIGHT_REBOOT_SHUTDOWN


class FlightPhaseCommands(CommandHandlers):
    """The phase of a flight by command."""

    def __init__(self, vehicle: VehicleAccess) -> None:
        """Args: the vehicle that is commanded."""
        super().__init__(vehicle)
        self._reset_at, self._resets = -math.inf, 0

    def handlers(self) -> Handlers:
        """By MAV_CMD."""
        return {
            dialect.MAV_CMD_DO_PAUSE_CONTINUE: self._pause_continue,
            dialect.MAV_CMD_DO_FLIGHTTERMINATION: self._terminate,
            dialect.MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN: self._reboot_shutdown,
            dialect.MAV_CMD_COMPONENT_ARM_DISARM: self._arm_disarm,
        }

    def _pause_continue(self, params: Params) -> Acknowledgement:
        paused = self._vehicle.snapshot().phase is Phase.PAUSED
        if params[0] == 0.0:
            return Acknowledgement(Result.ACCEPTED) if paused else self._queue(Pause, "paused")
        if params[0] == 1.0:
            return self._queue(Resume, "resumed") if paused else Acknowledgement(Result.ACCEPTED)
        return Acknowledgement(Result.DENIED)

    def _terminate(self, params: Params) -> Acknowledgement:
        if not params[0] > 0.5:
            return Acknowledgement(Result.DENIED, "refused: a flight that has ended stays so")
        if not self._in_flight():
            return Acknowledgement(Result.ACCEPTED)
        return self._queue(End, "ended by command")

    def _reboot_shutdown(self, params: Params) -> Acknowledgement:
        action = whole_number(params[0])
        if action == REBOOT:
            if self._resets >= MOST_RESETS:
                return Acknowledgement(Result.REJECTED, f"refused: {MOST_RESETS} resets were flown")
            now = time.monotonic()
            if now < self._reset_at + RESET_INTERVAL:
                reason = f"refused: one reset in {RESET_INTERVAL:g} s"
                return Acknowledgement(Result.REJECTED, reason)
            self._reset_at, self._resets = now, self._resets + 1
            self._vehicle.queue_command(Reset())
            return Acknowledgement(Result.ACCEPTED, "reset: the scenario begins anew")
        if action == SHUTDOWN:
            self._vehicle.leaves_after_flight = True
            self._vehicle.queue_command(End())
            return Acknowledgement(Result.ACCEPTED, "ended by command, the link closes")
        return Acknowledgement(Result.UNSUPPORTED)

    def _arm_disarm(self, params: Params) -> Acknowledgement:
        if self._in_flight():
            return Acknowledgement(Result.REJECTED, "refused: it is in the air and stays armed")
        return Acknowledgement(Result.REJECTED, "refused: reboot begins a flight")
