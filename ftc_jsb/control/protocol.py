"""The protocol of an outer loop of your own: see docs/loops.md for a template."""

from collections.abc import Mapping
from typing import NamedTuple, Protocol

from ftc_jsb.aircraft.point_mass_file import PointMass
from ftc_jsb.scenario.loop import Loop
from ftc_jsb.scenario.sensors import Sensors


class LoopSetup(NamedTuple):
    """What a loop is built from."""

    aircraft: PointMass  # the point mass that the loop may count on
    mass: float  # at the start [kg]
    settings: Loop  # [loop] of the scenario
    dt: float  # sample time [s]
    sensors: Sensors = Sensors()  # [sensors] of the scenario


class Measurement(NamedTuple):
    """What the aircraft measures, SI and rad; nan where a plant does not measure it."""

    airspeed: float
    flight_path_angle: float
    heading: float
    north: float
    east: float
    altitude: float
    load_factor: float
    bank_angle: float
    alpha: float
    sideslip: float
    pitch_rate: float
    elevator: float
    flap: float
    roll: float
    pitch: float
    yaw: float
    roll_rate: float
    yaw_rate: float
    acceleration: float  # of the force along the velocity, thrust less drag, over mass [m/s^2]
    aileron: float
    rudder: float


class Reference(NamedTuple):
    """What is to be tracked, SI and rad, its rate, and the path that it makes."""

    airspeed: float
    flight_path_angle: float
    heading: float
    airspeed_rate: float
    flight_path_angle_rate: float
    heading_rate: float
    north: float
    east: float
    altitude: float


class Command(NamedTuple):
    """What the loop asks of the plant: thrust of a healthy engine [N], load factor, bank [rad].

    `estimates` may set any of the recording's `*_est`, `*_std` and `fault_declared` by name.
    """

    thrust: float
    load_factor: float
    bank_angle: float
    estimates: Mapping[str, float] = {}


class OuterLoop(Protocol):
    """An outer loop. It is built with a `LoopSetup` and then asked once a sample."""

    def __init__(self, setup: LoopSetup) -> None:
        """Build the loop; raise ValueError if the settings do not suit it."""

    def step(self, time: float, measurement: Measurement, reference: Reference) -> Command:
        """Commands for the sample that starts at `time` [s]."""
