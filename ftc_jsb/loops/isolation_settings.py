"""Settings of the isolation from the instruments of a scenario and the variances that flights have taught."""

import math

import numpy as np
import numpy.typing as npt

from ftc_jsb.disturbance.sensor_profiles import PROFILES, Errors
from ftc_jsb.isolation.records import (
    AIR_X,
    DRIFT_ROW,
    FORCE,
    GYRO_X,
    INERTIAL_X,
    ISOLATION_SETTINGS,
    LIFT,
    RESIDUALS,
    SIDE,
    THRUST_ROW,
)
from ftc_jsb.isolation.scatter import CALM, GUST, START
from ftc_jsb.vocabulary.channels import SURFACES
from ftc_jsb.vocabulary.signals import ANGLES, SENSED

THRESHOLD, AT = 18.0, 0.01  # log likelihood ratio that chance exceeds so often an hour
STALE = 0.25  # [s], or so many periods:
STALE_PERIODS = 5
DEGREE = math.radians(1.0)
TOLERANCE = {  # within which an excluded instrument agrees again
    "airspeed": 2.0,  # m/s
    "altitude": 10.0,  # m
    "alpha": 0.3,  # deg, as all angles
    "sideslip": 0.5,
    "roll": 0.3,
    "pitch": 0.3,
    "yaw": 0.3,
    "roll_rate": 0.2,  # deg/s
    "pitch_rate": 0.2,
    "yaw_rate": 0.2,
    "load_factor_x": 0.02,
    "load_factor_y": 0.02,
    "load_factor_z": 0.02,
    "north": 10.0,  # m
    "east": 10.0,
    "elevator_position": 0.5,
    "flap_position": 0.5,
    "aileron_position": 0.5,
    "rudder_position": 0.5,
}
SIZE = {  # standard deviation of the errors that have to be reckoned with; positions: of their drift
    "airspeed": 20.0,  # m/s
    "altitude": 20.0,  # m/s
    "alpha": 5.0,  # deg, as all angles
    "sideslip": 5.0,
    "roll": 20.0,
    "pitch": 20.0,
    "yaw": 20.0,
    "roll_rate": 20.0,  # deg/s
    "pitch_rate": 20.0,
    "yaw_rate": 20.0,
    "load_factor_x": 1.0,
    "load_factor_y": 1.0,
    "load_factor_z": 2.0,
    "north": 20.0,  # m/s
    "east": 20.0,
    "elevator_position": 5.0,
    "flap_position": 5.0,
    "aileron_position": 5.0,
    "rudder_position": 5.0,
}
MADE_OF = {  # instruments that make up a residual
    INERTIAL_X: ("load_factor_x", "roll", "pitch", "north", "east", "altitude"),
    AIR_X: ("airspeed", "alpha", "sideslip", "north", "east", "altitude"),
    GYRO_X: ("roll", "pitch", "yaw", "roll_rate", "pitch_rate", "yaw_rate"),
    LIFT: ("alpha", "load_factor_z", "airspeed"),
    SIDE: ("sideslip", "load_factor_y"),
    FORCE: ("load_factor_x", "alpha", "sideslip", "airspeed", "elevator_position"),
}


USUAL = 0.01  # [s] between samples; what motion between two of them does to an integral goes by its square


def isolation_settings(
    sensors: dict[str, Errors], enabled: bool, false_alarms: float, dt: float
) -> npt.NDArray[np.void]:
    """() ISOLATION_SETTINGS for a suite of sensors.

    Args:
        sensors: errors of each signal, angles in degrees.
        enabled: whether faults are isolated at all.
        false_alarms: an hour, that the threshold is meant for.
        dt: sample time of the loop [s].
    """
    result = np.zeros((), ISOLATION_SETTINGS)
    s = result
    s["enabled"] = enabled
    s["threshold"] = threshold(false_alarms)
    scale = np.ones(RESIDUALS)
    for first, names in MADE_OF.items():
        width = 3 if first < LIFT else 1
        scale[first : first + width] = max(_worse(sensors[name], name) for name in names)
    slow = np.full(RESIDUALS, max(dt / USUAL, 1.0) ** 4)
    slow[-1] = 1.0  # nothing is integrated in the force along the velocity
    s["calm"] = np.square(CALM) * scale * slow
    s["gust"] = np.square(GUST)
    s["start"] = np.square(START) * scale
    for index, name in enumerate(SENSED):
        unit = DEGREE if name in ANGLES else 1.0
        errors = sensors[name]
        s["noise"][index] = errors.noise * unit
        s["ordinary"][index] = max(errors.noise, PROFILES["tactical"][name].noise) * unit
        s["bias"][index] = math.hypot(errors.bias, errors.bias_spread) * unit
        period = 1.0 / errors.rate if errors.rate > 0.0 else dt
        s["stale"][index] = max(STALE, STALE_PERIODS * period)
        s["tolerance"][index] = TOLERANCE[name] * unit
        s["sizes"][index] = SIZE[name] * unit
    s["sizes"][DRIFT_ROW:THRUST_ROW] = s["sizes"][SENSED.index("roll")]
    s["sizes"][THRUST_ROW] = 1.0
    s["position_lag"] = [sensors[name].delay for name in ("north", "east", "altitude")]
    pick_offs = (sensors[f"{name}_position"] for name in SURFACES)
    s["pick_off_lag"] = [min(errors.delay / dt, 1.0) for errors in pick_offs]
    late = sensors["roll"].delay - sensors["roll_rate"].delay
    s["gyro_lead"] = min(max(late / dt + 0.5, 0.0), 1.0)
    return result


def threshold(false_alarms: float) -> float:
    """Log likelihood ratio for a number of false alarms an hour: chance falls off as its exponential."""
    return THRESHOLD - math.log(false_alarms / AT)


def _worse(errors: Errors, name: str) -> float:
    """Variance of an instrument over that of the suite that the variances were learned with; 1 or more."""
    known = PROFILES["tactical"][name]
    return max(
        (errors.noise**2 + errors.bias**2 + errors.bias_spread**2)
        / (known.noise**2 + known.bias_spread**2),
        1.0,
    )
