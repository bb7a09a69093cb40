"""COMMAND_LONG and COMMAND_INT: what each command does, and one COMMAND_ACK for each."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from pydantic import ValidationError
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.disturbance.faults import CAPACITY
from ftc_jsb.mavlink.answers import autopilot_version
from ftc_jsb.mavlink.desk import Desk
from ftc_jsb.mavlink.failures import SENSORS, failure
from ftc_jsb.mavlink.snapshot import Phase
from ftc_jsb.mavlink.status import IN_THE_AIR, home_position
from ftc_jsb.mavlink.streams import BY_ID, contents
from ftc_jsb.simulation.commands import (
    Command,
    End,
    Pause,
    Reset,
    Resume,
    SetAirspeed,
    SetAltitude,
    SetFaults,
    SetFlightPath,
    SetHeading,
)
from ftc_jsb.simulation.fly import point_mass_of

ACCEPTED = dialect.MAV_RESULT_ACCEPTED
DENIED = dialect.MAV_RESULT_DENIED
UNSUPPORTED = dialect.MAV_RESULT_UNSUPPORTED
REJECTED = dialect.MAV_RESULT_TEMPORARILY_REJECTED

SET_FLIGHT_PATH = dialect.MAV_CMD_USER_1  # parameter 1: degrees
REBOOT, SHUTDOWN = 1, 2  # parameter 1 of PREFLIGHT_REBOOT_SHUTDOWN

Params = tuple[float, ...]  # the seven of a command; nan where it has none


class Reply(NamedTuple):
    """The result of a command, and why, where that is not plain."""

    result: int
    reason: str = ""


class CommandProtocol:
    """Answers commands."""

    def __init__(self, desk: Desk) -> None:
        """Args: the vehicle."""
        self._desk = desk
        self._engines = point_mass_of(desk.scenario).thrust.engines
        self._injected: dict[tuple[str, ...], SetFaults] = {}
        self._handlers: dict[int, Callable[[Params], Reply]] = {
            dialect.MAV_CMD_INJECT_FAILURE: self._inject_failure,
            dialect.MAV_CMD_DO_CHANGE_SPEED: self._change_speed,
            dialect.MAV_CMD_GUIDED_CHANGE_SPEED: self._change_speed,
            dialect.MAV_CMD_GUIDED_CHANGE_HEADING: self._change_heading,
            dialect.MAV_CMD_DO_CHANGE_ALTITUDE: self._do_change_altitude,
            dialect.MAV_CMD_GUIDED_CHANGE_ALTITUDE: self._guided_change_altitude,
            SET_FLIGHT_PATH: self._change_flight_path,
            dialect.MAV_CMD_DO_PAUSE_CONTINUE: self._pause_continue,
            dialect.MAV_CMD_DO_FLIGHTTERMINATION: self._terminate,
            dialect.MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN: self._reboot_shutdown,
            dialect.MAV_CMD_COMPONENT_ARM_DISARM: self._arm_disarm,
            dialect.MAV_CMD_SET_MESSAGE_INTERVAL: self._set_interval,
            dialect.MAV_CMD_GET_MESSAGE_INTERVAL: self._get_interval,
            dialect.MAV_CMD_REQUEST_MESSAGE: self._request_message,
            dialect.MAV_CMD_GET_HOME_POSITION: self._home,
            dialect.MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES: self._capabilities,
        }

    def restart(self) -> None:
        """A flight begins anew."""
        self._injected.clear()

    def command_long(self, message: Any) -> None:
        """Answer a COMMAND_LONG."""
        self._answer(message, tuple(getattr(message, f"param{k}") for k in range(1, 8)))

    def command_int(self, message: Any) -> None:
        """Answer a COMMAND_INT."""
        four = tuple(getattr(message, f"param{k}") for k in range(1, 5))
        self._answer(message, (*four, message.x, message.y, message.z))

    def _answer(self, message: Any, params: Params) -> None:
        handler = self._handlers.get(message.command)
        reply = handler(params) if handler else Reply(UNSUPPORTED)
        self._desk.send(
            dialect.MAVLink_command_ack_message,
            {
                "command": message.command,
                "result": reply.result,
                "target_system": message.get_srcSystem(),
                "target_component": message.get_srcComponent(),
            },
        )
        if reply.reason:
            self._desk.say(dialect.MAV_SEVERITY_NOTICE, reply.reason)

    # --- what changes the flight ---------------------------------------------------------------

    def _flown(self, make: Callable[[], Command], text: str = "") -> Reply:
        """Give a command to the flight, if there is one and the command is in its range."""
        if self._desk.snapshot().phase not in IN_THE_AIR:
            return Reply(REJECTED, "refused: not in flight")
        try:
            command = make()
        except ValidationError as error:
            problem = error.errors(include_url=False)[0]
            return Reply(DENIED, f"refused: {problem['loc'][-1]}: {problem['msg']}")
        self._desk.give(command)
        return Reply(ACCEPTED, text)

    def _inject_failure(self, params: Params) -> Reply:
        if self._desk.parameters["SYS_FAILURE_EN"] != 1.0:
            return Reply(DENIED, "refused: SYS_FAILURE_EN is 0")
        unit, kind, instance = (_whole(value) for value in params[:3])
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
        reply = self._flown(lambda: command, _told(command, unit))
        if reply.result == ACCEPTED:
            self._injected = {**others, command.targets: command}
        return reply

    def _change_speed(self, params: Params) -> Reply:
        kind, speed = _whole(params[0]), params[1]
        if kind == dialect.SPEED_TYPE_GROUNDSPEED and not self._still_air():
            return Reply(DENIED, "refused: airspeed only, there is wind")
        if kind not in (dialect.SPEED_TYPE_AIRSPEED, dialect.SPEED_TYPE_GROUNDSPEED):
            return Reply(UNSUPPORTED)
        rate = self._desk.parameters["SP_SPD_RATE"]
        return self._flown(
            lambda: SetAirspeed(value=speed, rate=rate), f"airspeed to {speed:.1f} m/s"
        )

    def _still_air(self) -> bool:
        wind = self._desk.scenario.wind
        return not (wind.speed or wind.shear or wind.gust) and wind.turbulence == "none"

    def _change_heading(self, params: Params) -> Reply:
        degrees, acceleration = params[1], params[2]
        rate = math.radians(self._desk.parameters["SP_HDG_RATE"])
        row = self._desk.snapshot().row
        if acceleration > 0.0 and row:  # [m/s^2], centripetal
            rate = min(acceleration / row["airspeed"], rate)
        return self._flown(
            lambda: SetHeading(value=math.radians(degrees), rate=rate),
            f"heading to {degrees:.1f} deg",
        )

    def _change_flight_path(self, params: Params) -> Reply:
        degrees = params[0]
        rate = math.radians(self._desk.parameters["SP_FPA_RATE"])
        return self._flown(
            lambda: SetFlightPath(value=math.radians(degrees), rate=rate),
            f"flight path to {degrees:.1f} deg",
        )

    def _do_change_altitude(self, params: Params) -> Reply:
        frames = (
            dialect.MAV_FRAME_GLOBAL,
            dialect.MAV_FRAME_GLOBAL_INT,
            dialect.MAV_FRAME_GLOBAL_RELATIVE_ALT,  # home is at sea level
            dialect.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT,
        )
        if _whole(params[1]) not in frames:
            return Reply(DENIED, "refused: altitude above mean sea level only")
        return self._altitude(params[0], math.inf)

    def _guided_change_altitude(self, params: Params) -> Reply:
        return self._altitude(params[6], params[2] if params[2] > 0.0 else math.inf)

    def _altitude(self, altitude: float, climb_rate: float) -> Reply:
        steepest = math.radians(self._desk.parameters["SP_FPA_MAX"])
        rate = math.radians(self._desk.parameters["SP_FPA_RATE"])
        row = self._desk.snapshot().row
        if row and climb_rate < row["airspeed"]:
            steepest = min(steepest, math.asin(climb_rate / row["airspeed"]))
        return self._flown(
            lambda: SetAltitude(value=altitude, flight_path=steepest, rate=rate),
            f"altitude to {altitude:.0f} m",
        )

    def _pause_continue(self, params: Params) -> Reply:
        paused = self._desk.snapshot().phase is Phase.PAUSED
        if params[0] == 0.0:
            return Reply(ACCEPTED) if paused else self._flown(Pause, "paused")
        if params[0] == 1.0:
            return self._flown(Resume, "resumed") if paused else Reply(ACCEPTED)
        return Reply(DENIED)

    def _terminate(self, params: Params) -> Reply:
        if not params[0] > 0.5:
            return Reply(DENIED, "refused: a flight that has ended stays so")
        if self._desk.snapshot().phase not in IN_THE_AIR:
            return Reply(ACCEPTED)
        return self._flown(End, "ended by command")

    def _reboot_shutdown(self, params: Params) -> Reply:
        action = _whole(params[0])
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

    # --- what is asked -------------------------------------------------------------------------

    def _set_interval(self, params: Params) -> Reply:
        message, interval = _whole(params[0]), params[1]
        stream = BY_ID.get(message)
        if stream is None:
            return Reply(UNSUPPORTED)
        if interval == 0.0:
            rate = stream.rate
        elif interval < 0.0:
            rate = 0.0
        else:
            rate = 1e6 / interval
        done = math.isfinite(rate) and self._desk.timetable.set_rate(message, rate)
        return Reply(ACCEPTED if done else DENIED)

    def _get_interval(self, params: Params) -> Reply:
        message = _whole(params[0])
        if not 0 <= message < 2**16:
            return Reply(DENIED)
        rate = self._desk.timetable.rate(message)
        interval = 1e6 / rate if rate else -1 if message in BY_ID else 0  # 0: not available
        self._desk.send(
            dialect.MAVLink_message_interval_message,
            {"message_id": message, "interval_us": interval},
        )
        return Reply(ACCEPTED)

    def _request_message(self, params: Params) -> Reply:
        message = _whole(params[0])
        if message == dialect.MAVLink_autopilot_version_message.id:
            return self._capabilities(params)
        stream = BY_ID.get(message)
        if stream is None:
            return Reply(UNSUPPORTED)
        sent = False
        for fields in contents(stream, self._desk.snapshot()):
            self._desk.send(stream.message, fields)
            sent = True
        return Reply(ACCEPTED if sent else REJECTED)

    def _home(self, params: Params) -> Reply:
        fields = home_position(self._desk.snapshot())
        self._desk.send(dialect.MAVLink_home_position_message, fields)
        return Reply(ACCEPTED)

    def _capabilities(self, params: Params) -> Reply:
        self._desk.send(dialect.MAVLink_autopilot_version_message, autopilot_version())
        return Reply(ACCEPTED)


def _told(command: SetFaults, unit: int) -> str:
    """What a failure of a sensor is; others are seen in the recording."""
    if unit not in SENSORS:
        return ""
    if not command.faults:
        return f"fault removed: {command.targets[0]}"
    return f"fault injected: {command.faults[0].target} {command.faults[0].kind}"


def _whole(value: float) -> int:
    """A number that names something; -1 where it is none, 0 where it was left out."""
    if math.isnan(value):
        return 0
    return int(value) if math.isfinite(value) and value == int(value) else -1
