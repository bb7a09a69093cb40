"""Sensor suites by name: the errors of instruments that such aircraft carry.

`tactical` is a calibrated air-data computer with vanes, an inertial navigator of tactical grade
aided by satellites, and position pick-offs on the surfaces. The numbers are typical of data
sheets, rounded; a scenario may replace any of them.
"""

from typing import NamedTuple


class Errors(NamedTuple):
    """Errors of one sensor, in the signal's unit; angles in degrees."""

    noise: float = 0.0  # standard deviation of each reading
    bias: float = 0.0
    bias_spread: float = 0.0  # standard deviation of a bias drawn for each flight
    rate: float = 0.0  # Hz; 0 = at every sample
    delay: float = 0.0  # s


_ATTITUDE = Errors(noise=0.02, bias_spread=0.05, delay=0.01)  # deg
_ANGULAR_RATE = Errors(noise=0.05, bias_spread=0.003, delay=0.005)  # deg/s; 10 deg/h
_VANE = Errors(noise=0.1, bias_spread=0.1, rate=50.0, delay=0.02)  # deg
_ACCELEROMETER = Errors(noise=0.01, bias_spread=0.001, delay=0.005)  # g
_POSITION = Errors(noise=0.5, bias_spread=3.0, rate=20.0, delay=0.05)  # m
_PICK_OFF = Errors(noise=0.05, bias_spread=0.05, delay=0.005)  # deg

PROFILES: dict[str, dict[str, Errors]] = {
    "perfect": {},
    "tactical": {
        "airspeed": Errors(noise=0.3, bias_spread=0.5, rate=50.0, delay=0.02),  # m/s
        "altitude": Errors(noise=1.0, bias_spread=5.0, rate=50.0, delay=0.02),  # m
        "alpha": _VANE,
        "sideslip": _VANE,
        "roll": _ATTITUDE,
        "pitch": _ATTITUDE,
        "yaw": _ATTITUDE,
        "roll_rate": _ANGULAR_RATE,
        "pitch_rate": _ANGULAR_RATE,
        "yaw_rate": _ANGULAR_RATE,
        "load_factor_x": _ACCELEROMETER,
        "load_factor_y": _ACCELEROMETER,
        "load_factor_z": _ACCELEROMETER,
        "north": _POSITION,
        "east": _POSITION,
        "elevator_position": _PICK_OFF,
        "flap_position": _PICK_OFF,
        "aileron_position": _PICK_OFF,
        "rudder_position": _PICK_OFF,
    },
}
