"""Covariances of the filter from what is known before the flight: sensors and turbulence.

Nothing here is tuned to a scenario. R is the noise of the instruments that make up each output. Q
is what the process model leaves out: the gusts of a design turbulence, as the random walk that the
Dryden spectra are at high frequency. The Q of the thrust's effectiveness follows from the time in which a loss
shall be followed (`response_time`); it is set where the flight starts, from the thrust of trim. Load factor and
bank are told from angles, which gusts turn too: their Q is what measurement has shown.
"""

import math
from typing import NamedTuple

from ftc_jsb.disturbance.sensor_profiles import Errors
from ftc_jsb.disturbance.weather import SCALE_LENGTH, intensity
from ftc_jsb.units import STANDARD_GRAVITY

GUST = intensity("moderate", 3048.0)  # [m/s]
DESIGN_AIRSPEED = 250.0  # [m/s]
DRAG_ANGLES = (
    "alpha",
    "sideslip",
    "elevator_position",
    "flap_position",
)  # drag is measured by them
# [1/s]: variance that the effectiveness of load factor and of bank gains. Losses of 0.7 of either in moderate
# turbulence by tactical sensors are followed best by it: ten times as much is noise, a tenth is late.
PATH_CHANNELS = 1e-3
LEAST = 1e-10  # a variance that stands for none: the one printed in the paper


class Covariances(NamedTuple):
    """Diagonals of Q and R for airspeed, flight path angle and heading, and the accelerometer's R."""

    process: tuple[float, float, float]  # a step: m^2/s^2, rad^2, rad^2
    measurement: tuple[float, float, float]
    acceleration: float  # of the accelerometer alone, m^2/s^4
    angles: tuple[float, ...]  # of DRAG_ANGLES, rad^2


class Biases(NamedTuple):
    """Standard deviations of what the instruments of a flight may be off by, all of the time."""

    acceleration: float  # m/s^2
    airspeed: float  # m/s
    angles: tuple[float, ...]  # of DRAG_ANGLES, rad


def biases(sensors: dict[str, Errors]) -> Biases:
    """Biases of a suite of sensors, those that are given and those that are drawn for a flight."""

    def size(name: str) -> float:
        return math.hypot(sensors[name].bias, sensors[name].bias_spread)

    return Biases(
        size("load_factor_x") * STANDARD_GRAVITY,
        size("airspeed"),
        tuple(math.radians(size(name)) for name in DRAG_ANGLES),
    )


def covariances(sensors: dict[str, Errors], dt: float) -> Covariances:
    """Covariances for a suite of sensors.

    Args:
        sensors: errors of each signal, angles in degrees.
        dt: sample time of the loop [s].
    """

    def variance(name: str) -> float:
        """Of one sample: a reading that is held over n samples counts n times."""
        errors = sensors[name]
        held = max(1.0, 1.0 / (errors.rate * dt)) if errors.rate > 0.0 else 1.0
        return held * errors.noise**2

    def angle(*names: str) -> float:
        return sum(variance(name) for name in names) * math.radians(1.0) ** 2

    time = SCALE_LENGTH / DESIGN_AIRSPEED  # [s]
    along = (
        GUST**2 * 2.0 / time * dt
    )  # random walk of white noise through sigma sqrt(2 tau)/(1 + tau s)
    across = GUST**2 * 3.0 / time * dt / DESIGN_AIRSPEED**2  # sigma sqrt(3/tau) at high frequency
    vanes = angle("alpha", "sideslip")
    return Covariances(
        (along, across, across),
        (
            max(variance("airspeed"), LEAST),
            max(angle("pitch", "roll") + vanes, LEAST),
            max(angle("yaw", "roll") + vanes, LEAST),
        ),
        max(variance("load_factor_x") * STANDARD_GRAVITY**2, 1e-6),
        tuple(angle(name) for name in DRAG_ANGLES),
    )
