"""The messages that are sent of their own accord, how often, and when each is due."""

import time
from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.link.message_fields import Fields
from ftc_jsb.mavlink.telemetry import motion_messages as motion
from ftc_jsb.mavlink.telemetry import outer_loop_messages as outer_loop
from ftc_jsb.mavlink.telemetry import status_messages as status
from ftc_jsb.mavlink.telemetry.snapshot import Phase, Snapshot

HIGHEST_RATE = 200.0  # [Hz] that a message can be asked for
EARLY = 0.01  # [s] by which messages are sent early, so that several are made of one snapshot
BUDGET = 1000.0  # [1/s] messages that stations may ask for, all together
MOST_STATIONS = 16  # that have rates of their own; of more the one longest silent is forgotten
STATION_TIMEOUT = 30.0  # [s] of silence after which nothing is sent for a station any more
LOWEST_HEARTBEAT_RATE = 1.0  # [Hz]: clients give a vehicle up that is slower


class Stream(NamedTuple):
    """A message, its default rate, what builds it, and its group for REQUEST_DATA_STREAM."""

    message: type[Any]
    rate: float  # [Hz]; 0 = on request
    build: Callable[[Snapshot], Fields | Iterable[Fields]]
    group: int
    of_row: bool = True  # made of a row: not sent before the first
    several: int = 1  # messages each time

    @property
    def id(self) -> int:
        """Of the message."""
        return int(self.message.id)


_STATUS = dialect.MAV_DATA_STREAM_EXTENDED_STATUS
_POSITION = dialect.MAV_DATA_STREAM_POSITION
_CONTROL = dialect.MAV_DATA_STREAM_RAW_CONTROLLER
_ATTITUDE = dialect.MAV_DATA_STREAM_EXTRA1
_HUD = dialect.MAV_DATA_STREAM_EXTRA2
_EXTRA = dialect.MAV_DATA_STREAM_EXTRA3
_VALUES = len(outer_loop.OUTER_LOOP_VALUES)

STREAMS = (
    Stream(dialect.MAVLink_heartbeat_message, 1.0, status.heartbeat, -1, of_row=False),
    Stream(dialect.MAVLink_sys_status_message, 1.0, status.sys_status, _STATUS, of_row=False),
    Stream(dialect.MAVLink_system_time_message, 1.0, status.system_time, _EXTRA, of_row=False),
    Stream(dialect.MAVLink_extended_sys_state_message, 1.0, status.extended_sys_state, _STATUS, of_row=False),
    Stream(dialect.MAVLink_home_position_message, 0.5, status.home_position, _STATUS, of_row=False),
    Stream(dialect.MAVLink_attitude_message, 25.0, motion.attitude, _ATTITUDE),
    Stream(dialect.MAVLink_attitude_quaternion_message, 0.0, motion.attitude_quaternion, _ATTITUDE),
    Stream(dialect.MAVLink_global_position_int_message, 10.0, motion.global_position_int, _POSITION),
    Stream(dialect.MAVLink_local_position_ned_message, 2.0, motion.local_position_ned, _POSITION),
    Stream(dialect.MAVLink_vfr_hud_message, 10.0, motion.vfr_hud, _HUD),
    Stream(dialect.MAVLink_gps_raw_int_message, 2.0, motion.gps_raw_int, _STATUS),
    Stream(dialect.MAVLink_attitude_target_message, 10.0, motion.attitude_target, _ATTITUDE),
    Stream(dialect.MAVLink_nav_controller_output_message, 5.0, motion.nav_controller_output, _CONTROL),
    Stream(dialect.MAVLink_actuator_output_status_message, 5.0, motion.actuator_output_status, _CONTROL),
    Stream(dialect.MAVLink_hil_state_quaternion_message, 5.0, motion.hil_state_quaternion, _EXTRA),
    Stream(dialect.MAVLink_wind_cov_message, 1.0, motion.wind_cov, _EXTRA),
    Stream(dialect.MAVLink_estimator_status_message, 1.0, outer_loop.estimator_status, _STATUS),
    Stream(dialect.MAVLink_named_value_float_message, 5.0, outer_loop.named_value_float, _EXTRA, True, _VALUES),
    Stream(dialect.MAVLink_debug_float_array_message, 10.0, outer_loop.debug_float_array, _EXTRA),
)  # fmt: skip
STREAM_BY_ID = {stream.id: stream for stream in STREAMS}
HEARTBEAT = dialect.MAVLink_heartbeat_message.id


def message_fields(stream: Stream, s: Snapshot) -> Iterable[Fields]:
    """Fields of the messages of a stream at a snapshot; none before what it is made of is there."""
    if stream.of_row and s.phase is Phase.WAITING:
        return ()
    built = stream.build(s)
    return (built,) if isinstance(built, dict) else built


Station = tuple[int, int]  # system and component
_ANYBODY: Station = (0, 0)


class StreamSchedule:
    """When each message is due. A late one is sent once, not made up for.

    Every station has rates of its own, the defaults until it asks for others; a message goes out as often
    as the station that wants it most often wants it, so that none slows another's.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        """Args: gives the time [s]; the messages start spread over their first period."""
        self._clock = clock
        now = clock()
        self._wanted: dict[
            Station, dict[int, float]
        ] = {}  # [Hz] by message, where it was asked for
        self._heard: dict[Station, float] = {}
        self._period: dict[int, float] = {}
        self._due: dict[int, float] = {}
        for index, stream in enumerate(STREAMS):
            if stream.rate > 0.0:
                self._period[stream.id] = 1.0 / stream.rate
                spread = index / len(STREAMS) if stream.of_row else 0.0
                self._due[stream.id] = now + spread / stream.rate

    def due(self) -> list[Stream]:
        """Messages to be sent now."""
        now = self._clock()
        self._forget(now - STATION_TIMEOUT)
        found = []
        for message, when in self._due.items():
            if when <= now + EARLY:
                found.append(STREAM_BY_ID[message])
                after = when + self._period[message]
                self._due[message] = after if after > now else now + self._period[message]
        return found

    def next(self) -> float:
        """When the next message is due [s]."""
        return min(self._due.values())

    def rate(self, message: int) -> float:
        """Of a message [Hz]; 0 = not sent."""
        period = self._period.get(message)
        return 1.0 / period if period else 0.0

    def hear(self, station: Station) -> None:
        """A station is there."""
        new = station not in self._heard
        if new and len(self._heard) >= MOST_STATIONS:
            self._drop(min(self._heard, key=self._heard.__getitem__))
        self._heard[station] = self._clock()
        if new and self._wanted:
            self._use_rates()

    def set_rate(self, message: int, rate: float, station: Station = _ANYBODY) -> bool:
        """Send a message to a station at `rate` [Hz], 0 for never; whether that can be done."""
        if message not in STREAM_BY_ID or not 0.0 <= rate <= HIGHEST_RATE:
            return False
        if message == HEARTBEAT and rate < LOWEST_HEARTBEAT_RATE:
            return False
        more = max(rate - self.rate(message), 0.0) * STREAM_BY_ID[message].several
        if more > 0.0 and self._load() + more > BUDGET:
            return False
        self._wanted.setdefault(station, {})[message] = rate
        self.hear(station)
        self._use_rate(message)
        return True

    def set_group(self, group: int, rate: float, station: Station = _ANYBODY) -> None:
        """REQUEST_DATA_STREAM: the rate of a group, or of all that have one."""
        for stream in STREAMS:
            every = group == dialect.MAV_DATA_STREAM_ALL and stream.rate > 0.0
            if stream.group >= 0 and (stream.group == group or every):
                self.set_rate(stream.id, min(rate, HIGHEST_RATE), station)

    def _load(self) -> float:
        """Messages a second."""
        return sum(STREAM_BY_ID[m].several / period for m, period in self._period.items())

    def _use_rates(self) -> None:
        for stream in STREAMS:
            self._use_rate(stream.id)

    def _use_rate(self, message: int) -> None:
        """The greatest that a station wants; of those that have not asked the default."""
        default = STREAM_BY_ID[message].rate
        wanted = [self._wanted.get(each, {}).get(message, default) for each in self._heard]
        rate = max(wanted, default=default)
        if rate == self.rate(message) or (rate > 0.0 and self._period.get(message) == 1.0 / rate):
            return
        self._period.pop(message, None)
        self._due.pop(message, None)
        if rate > 0.0:
            self._period[message] = 1.0 / rate
            self._due[message] = self._clock()

    def _forget(self, oldest: float) -> None:
        silent = [station for station, heard in self._heard.items() if heard < oldest]
        for station in silent:
            self._drop(station)
        if silent:
            self._use_rates()

    def _drop(self, station: Station) -> None:
        del self._heard[station]
        self._wanted.pop(station, None)
