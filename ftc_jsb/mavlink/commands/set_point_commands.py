"""Commands that change what is flown: airspeed, heading, altitude, flight path."""

import math

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.commands.command_handlers import (
    Acknowledgement,
    CommandHandlers,
    Handlers,
    Params,
    Result,
    whole_number,
)
from ftc_jsb.recording.commands import SetAirspeed, SetAltitude, SetFlightPath, SetHeading

SET_FLIGHT_PATH = dialect.MAV_CMD_USER_1  # parameter 1: degrees


class SetPointCommands(CommandHandlers):
    """Set-points by command."""

    def handlers(self) -> Handlers:
        """By MAV_CMD."""
        return {
            dialect.MAV_CMD_DO_CHANGE_SPEED: self._change_speed,
            dialect.MAV_CMD_GUIDED_CHANGE_SPEED: self._change_speed,
            dialect.MAV_CMD_GUIDED_CHANGE_HEADING: self._change_heading,
            dialect.MAV_CMD_DO_CHANGE_ALTITUDE: self._do_change_altitude,
            dialect.MAV_CMD_GUIDED_CHANGE_ALTITUDE: self._guided_change_altitude,
            SET_FLIGHT_PATH: self._change_flight_path,
        }

    def _change_speed(self, params: Params) -> Acknowledgement:
        kind, speed = whole_number(params[0]), params[1]
        if kind == dialect.SPEED_TYPE_GROUNDSPEED and not self._still_air():
            return Acknowledgement(Result.DENIED, "refused: airspeed only, there is wind")
        if kind not in (dialect.SPEED_TYPE_AIRSPEED, dialect.SPEED_TYPE_GROUNDSPEED):
            return Acknowledgement(Result.UNSUPPORTED)
        rate = self._vehicle.parameters["SP_SPD_RATE"]
        return self._queue(
            lambda: SetAirspeed(value=speed, rate=rate), f"airspeed to {speed:.1f} m/s"
        )

    def _still_air(self) -> bool:
        wind = self._vehicle.scenario.wind
        return not (wind.speed or wind.shear or wind.gust) and wind.turbulence == "none"

    def _change_heading(self, params: Params) -> Acknowledgement:
        degrees, acceleration = params[1], params[2]
        rate = math.radians(self._vehicle.parameters["SP_HDG_RATE"])
        row = self._vehicle.snapshot().row
        if acceleration > 0.0 and row:  # [m/s^2], centripetal
            rate = min(acceleration / row["airspeed"], rate)
        return self._queue(
            lambda: SetHeading(value=math.radians(degrees), rate=rate),
            f"heading to {degrees:.1f} deg",
        )

    def _change_flight_path(self, params: Params) -> Acknowledgement:
        degrees = params[0]
        rate = math.radians(self._vehicle.parameters["SP_FPA_RATE"])
        return self._queue(
            lambda: SetFlightPath(value=math.radians(degrees), rate=rate),
            f"flight path to {degrees:.1f} deg",
        )

    def _do_change_altitude(self, params: Params) -> Acknowledgement:
        frames = (
            dialect.MAV_FRAME_GLOBAL,
            dialect.MAV_FRAME_GLOBAL_INT,
            dialect.MAV_FRAME_GLOBAL_RELATIVE_ALT,  # home is at sea level
            dialect.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT,
        )
        if whole_number(params[1]) not in frames:
            return Acknowledgement(Result.DENIED, "refused: altitude above mean sea level only")
        return self._altitude(params[0], math.inf)

    def _guided_change_altitude(self, params: Params) -> Acknowledgement:
        return self._altitude(params[6], params[2] if params[2] > 0.0 else math.inf)

    def _altitude(self, altitude: float, climb_rate: float) -> Acknowledgement:
        steepest = math.radians(self._vehicle.parameters["SP_FPA_MAX"])
        rate = math.radians(self._vehicle.parameters["SP_FPA_RATE"])
        row = self._vehicle.snapshot().row
        if row and climb_rate < row["airspeed"]:
            steepest = min(steepest, math.asin(climb_rate / row["airspeed"]))
        return self._queue(
            lambda: SetAltitude(value=altitude, flight_path=steepest, rate=rate),
            f"altitude to {altitude:.0f} m",
        )
