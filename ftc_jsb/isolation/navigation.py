"""Position and velocity over the ground by accelerometers and attitude, held to the measured positions."""

import math
from typing import Any

from ftc_jsb.compiled import compiled
from ftc_jsb.units import STANDARD_GRAVITY
from ftc_jsb.vocabulary.kernel_types import Vector

SETTLING = 0.7  # [s]: time constant of the observer's triple pole
GYRO_SETTLING = 0.5  # [s]
STEADY = 20.0  # [s]: gyros of tactical grade go away by 0.06 deg in it
WIND_LAG = 30.0  # [s]
LEVEL_ENOUGH = 0.05  # cosine of the pitch: gimbal lock is not flown

Triple = tuple[float, float, float]


@compiled
def to_level(roll: float, pitch: float, yaw: float, vector: Triple) -> Triple:
    """A vector of body axes in north, east, down."""
    sr, cr = math.sin(roll), math.cos(roll)
    sp, cp = math.sin(pitch), math.cos(pitch)
    sy, cy = math.sin(yaw), math.cos(yaw)
    x, y, z = vector
    return (
        cp * cy * x + (sr * sp * cy - cr * sy) * y + (cr * sp * cy + sr * sy) * z,
        cp * sy * x + (sr * sp * sy + cr * cy) * y + (cr * sp * sy - sr * cy) * z,
        -sp * x + sr * cp * y + cr * cp * z,
    )


@compiled
def to_body(roll: float, pitch: float, yaw: float, vector: Triple) -> Triple:
    """A vector of north, east, down in body axes."""
    sr, cr = math.sin(roll), math.cos(roll)
    sp, cp = math.sin(pitch), math.cos(pitch)
    sy, cy = math.sin(yaw), math.cos(yaw)
    n, e, d = vector
    return (
        cp * cy * n + cp * sy * e - sp * d,
        (sr * sp * cy - cr * sy) * n + (sr * sp * sy + cr * cy) * e + sr * cp * d,
        (cr * sp * cy + sr * sy) * n + (cr * sp * sy - sr * cy) * e + cr * cp * d,
    )


@compiled
def inertial_acceleration(
    load: Triple, roll: float, pitch: float, yaw: float, gravity: float
) -> Triple:
    """Acceleration [m/s^2] north, east, down that accelerometers and attitude tell of.

    Args:
        load: load factors x, y, z as measured (z positive up).
        roll, pitch, yaw: [rad].
        gravity: [m/s^2].
    """
    force = (
        STANDARD_GRAVITY * load[0],
        STANDARD_GRAVITY * load[1],
        -STANDARD_GRAVITY * load[2],
    )
    north, east, down = to_level(roll, pitch, yaw, force)
    return north, east, down + gravity


@compiled
def air_velocity(
    airspeed: float, alpha: float, sideslip: float, roll: float, pitch: float, yaw: float
) -> Triple:
    """Velocity [m/s] through the air, north, east, down."""
    ca, sa = math.cos(alpha), math.sin(alpha)
    cb, sb = math.cos(sideslip), math.sin(sideslip)
    return to_level(roll, pitch, yaw, (airspeed * ca * cb, airspeed * sb, airspeed * sa * cb))


@compiled
def start_navigation(navigation: Any, position: Triple, velocity: Triple, attitude: Triple) -> None:
    """At the measured position and attitude; in still air."""
    n = navigation
    n.time = 0.0
    for k in range(3):
        n.position[k] = position[k]
        n.velocity[k] = velocity[k]
        n.acceleration[k], n.wind[k], n.rates[k], n.moving[k] = 0.0, 0.0, 0.0, 0.0
        n.reading[k], n.age[k] = position[k], 0.0
        n.attitude[k], n.steady[k] = attitude[k], attitude[k]


@compiled
def navigate(
    navigation: Any,
    acceleration: Triple,
    attitude: Triple,
    position: Triple,
    lag: Vector,
    dt: float,
) -> None:
    """Advance position, velocity and what is wrong with the acceleration by one sample.

    A critically damped observer of the third order, corrected by every new reading. What is wrong is taken to
    stay the same in body axes, as an accelerometer's error does.

    Args:
        navigation: NAVIGATION, changed in place.
        acceleration: [m/s^2], of `inertial_acceleration`.
        attitude: roll, pitch, yaw [rad].
        position: readings, north, east, down [m]; nan = silent.
        lag: (3,), [s] of those readings.
        dt: sample time [s].
    """
    n = navigation
    roll, pitch, yaw = attitude
    off = to_level(roll, pitch, yaw, (n.acceleration[0], n.acceleration[1], n.acceleration[2]))
    n.time += dt
    for k in range(3):
        rate = acceleration[k] + off[k]
        n.position[k] += dt * (n.velocity[k] + 0.5 * dt * rate)
        n.velocity[k] += dt * rate
        n.age[k] += dt
        if not math.isfinite(position[k]) or position[k] == n.reading[k]:
            continue
        n.reading[k] = position[k]
        away = position[k] - (n.position[k] - lag[k] * n.velocity[k])
        stays = math.exp(-n.age[k] / SETTLING)
        n.position[k] += (1.0 - stays**3) * away
        n.velocity[k] += 1.5 * (1.0 - stays * stays) * (1.0 - stays) / n.age[k] * away
        more = (1.0 - stays) ** 3 / (n.age[k] * n.age[k]) * away
        turned = to_body(
            roll,
            pitch,
            yaw,
            (more if k == 0 else 0.0, more if k == 1 else 0.0, more if k == 2 else 0.0),
        )
        for j in range(3):
            n.acceleration[j] += turned[j]
        n.age[k] = 0.0


@compiled
def learn_wind(navigation: Any, air: Triple, dt: float) -> None:
    """Advance the lasting wind: velocity over the ground less that through the air [m/s], lagged."""
    n = navigation
    share = max(1.0 - math.exp(-dt / WIND_LAG), dt / (n.time + 1.0))
    for k in range(3):
        n.wind[k] += share * (n.velocity[k] - air[k] - n.wind[k])


@compiled
def turn_by_gyros(
    navigation: Any, rates: Triple, measured: Triple, lead: float, dt: float
) -> Triple:
    """Gyros less the turning of the attitude [rad/s], in body axes.

    Args:
        navigation: NAVIGATION; its attitudes are advanced by the gyros and drawn to the measured one.
        rates: roll, pitch and yaw rate [rad/s].
        measured: roll, pitch, yaw [rad].
        lead: samples by which the gyros are ahead, 0 to 1.
        dt: sample time [s].
    """
    n = navigation
    p = rates[0] + lead * (n.rates[0] - rates[0])
    q = rates[1] + lead * (n.rates[1] - rates[1])
    r = rates[2] + lead * (n.rates[2] - rates[2])
    for k in range(3):
        n.rates[k] = rates[k]
    moving = euler_rates(measured[0], measured[1], (p, q, r))
    n.moving[0], n.moving[1], n.moving[2] = moving
    share = 1.0 - math.exp(-dt / GYRO_SETTLING)
    steadily = max(1.0 - math.exp(-dt / STEADY), dt / (n.time + 1.0))
    for k in range(3):
        n.attitude[k] += moving[k] * dt
        n.steady[k] += moving[k] * dt
        n.steady[k] += steadily * wrapped(measured[k] - n.steady[k])
    far = (
        wrapped(measured[0] - n.attitude[0]),
        wrapped(measured[1] - n.attitude[1]),
        wrapped(measured[2] - n.attitude[2]),
    )
    for k in range(3):
        n.attitude[k] += share * far[k]
    per = share / dt
    off = body_rates_of(measured[0], measured[1], (far[0] * per, far[1] * per, far[2] * per))
    return -off[0], -off[1], -off[2]


@compiled
def euler_rates(roll: float, pitch: float, body: Triple) -> Triple:
    """Rates of roll, pitch and yaw of the body rates [rad/s]."""
    sr, cr = math.sin(roll), math.cos(roll)
    sp, cp = math.sin(pitch), max(math.cos(pitch), LEVEL_ENOUGH)
    turn = (body[1] * sr + body[2] * cr) / cp
    return body[0] + turn * sp, body[1] * cr - body[2] * sr, turn


@compiled
def body_rates_of(roll: float, pitch: float, euler: Triple) -> Triple:
    """Body rates of the rates of roll, pitch and yaw [rad/s]."""
    sr, cr, sp, cp = math.sin(roll), math.cos(roll), math.sin(pitch), math.cos(pitch)
    return (
        euler[0] - euler[2] * sp,
        euler[1] * cr + euler[2] * cp * sr,
        euler[2] * cp * cr - euler[1] * sr,
    )


@compiled
def wrapped(angle: float) -> float:
    """An angle in [-pi, pi]."""
    return angle - 2.0 * math.pi * round(angle / (2.0 * math.pi))
