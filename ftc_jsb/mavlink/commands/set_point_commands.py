"""Commands that change what is flown: airspeed, heading, altitude, flight path."""

import math

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.commands.acknowledgement import (
    DENIED,
    UNSUPPORTED,
    Handlers,
    Params,
    Reply,
    given,
    whole,
)
from ftc_jsb.mavlink.commands.vehicle_access import Desk
from ftc_jsb.recording.commands import SetAirspeed, SetAltitude, SetFlightPath, SetHeading

SET_FLIGHT_PATH = dialect.MAV_CMD_USER_1  # parameter 1: degrees


class SetPointCommands:
    """Set-points by command."""

    def __init__(self, desk: Desk) -> None:
        """Args: the vehicle."""
        self._desk = desk
        self.handlers: Handlers = {
            dialect.MAV_CMD_DO_CHANGE_SPEED: self._change_speed,
            dialect.MAV_CMD_GUIDED_CHANGE_SPEED: self._change_speed,
            dialect.MAV_CMD_GUIDED_CHANGE_HEADING: self._change_heading,
            dialect.MAV_CMD_DO_CHANGE_ALTITUDE: self._do_change_altitude,
            dialect.MAV_CMD_GUIDED_CHANGE_ALTITUDE: self._guided_change_altitude,
            SET_FLIGHT_PATH: self._change_flight_path,
        }

    def _change_speed(self, params: Params) -> Reply:
        kind, speed = whole(params[0]), params[1]
        if kind == dialect.SPEED_TYPE_GROUNDSPEED and not self._still_air():
            return Reply(DENIED, "refused: airspeed only, there is wind")
        if kind not in (dialect.SPEED_TYPE_AIRSPEED, dialect.SPEED_TYPE_GROUNDSPEED):
            return Reply(UNSUPPORTED)
        rate = self._desk.parameters["SP_SPD_RATE"]
        return given(
            self._desk, lambda: SetAirspeed(value=speed, rate=rate), f"airspeed to {speed:.1f} m/s"
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
        return given(
            self._desk,
            lambda: SetHeading(value=math.radians(degrees), rate=rate),
            f"heading to {degrees:.1f} deg",
        )

    def _change_flight_path(self, params: Params) -> Reply:
        degrees = params[0]
        rate = math.radians(self._desk.parameters["SP_FPA_RATE"])
        return given(
            self._desk,
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
        if whole(params[1]) not in frames:
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
        return given(
            self._desk,
            lambda: SetAltitude(value=altitude, flight_path=steepest, rate=rate),
            f"altitude to {altitude:.0f} m",
        )
