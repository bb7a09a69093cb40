"""What stands in for an excluded instrument: what the others, and the model, say of its signal."""

import math

from ftc_jsb.compiled import compiled
from ftc_jsb.isolation.navigation import air_velocity, body_rates_of, wrapped
from ftc_jsb.isolation.records import (
    ACCEPTED,
    COUNT,
    DISAGREES,
    INERTIAL_X,
    LONGEST,
    SURFACE_COUNT,
)
from ftc_jsb.isolation.redundancy import (
    AIRSPEED,
    ALPHA,
    ALTITUDE,
    EAST,
    LOAD_X,
    LOAD_Y,
    LOAD_Z,
    NORTH,
    PITCH,
    ROLL,
    ROLL_RATE,
    SIDESLIP,
    YAW,
    YAW_RATE,
    modelled,
)
from ftc_jsb.isolation.surfaces import pick_off_of
from ftc_jsb.point_mass.model import Condition
from ftc_jsb.units import STANDARD_GRAVITY
from ftc_jsb.vocabulary.kernel_types import IsolationState, ModelRecord, Vector

TURNING_LAG = 0.03  # [s] of body rates by changes of the attitude
LOAD_LAG = 5.0  # [s] in which the error of a gyro or an accelerometer is followed
FIRST_GUESS = 0.3  # [s] of the attitude's turning that the first guess of a gyro's error is worth
FOUND = 0.7  # of it, by the observer in the time after its exclusion
SETTLED = 2.5  # [s] until a wrong acceleration has left the observer
FAR = 1e3  # of any unit
AIR_LAG = 5.0  # [s]: velocity over the ground without a position goes to that through the air


@compiled
def accept(
    m: ModelRecord, at: Condition, thrust: float, x: IsolationState, raw: Vector, dt: float
) -> None:
    """Signals of this sample: readings, or where an instrument is silent or excluded what stands in for it.

    Args:
        m, at, thrust: model, at this condition, thrust [N].
        x: ISOLATION; `signals` is written.
        raw: (COUNT,) readings; nan = silent.
        dt: sample time [s].
    """
    for k in range(COUNT):
        if x.excluded[k] == ACCEPTED and math.isfinite(raw[k]):
            x.signals[k] = raw[k]
    n = x.navigation
    for j in range(SURFACE_COUNT):
        k = pick_off_of(j)
        if not (x.excluded[k] == ACCEPTED and math.isfinite(raw[k])) and math.isfinite(
            x.surfaces[j].due
        ):
            x.signals[k] = x.surfaces[j].due + x.surfaces[j].lasting
    for axis in range(3):
        if x.excluded[ROLL + axis] != ACCEPTED:
            x.signals[ROLL + axis] = n.steady[axis] + n.moving[axis] * dt
    _turning(x, dt)
    for axis in range(3):
        k = ROLL_RATE + axis
        if x.excluded[k] == DISAGREES:
            x.out[k] += dt
            share = dt / min(LOAD_LAG, x.out[k] + FIRST_GUESS)
            x.away[k] += share * (x.readings[k] - x.turning[axis] - x.away[k])
            x.signals[k] = x.readings[k] - x.away[k]
        elif x.excluded[k] != ACCEPTED:
            x.signals[k] = x.turning[axis]
    for axis in range(2):
        k = LOAD_X + axis
        if x.excluded[k] != ACCEPTED:
            if 0.0 < x.wait <= dt:  # the observer has found most of what is left
                x.away[k] -= n.acceleration[axis] / (FOUND * STANDARD_GRAVITY)
                n.acceleration[axis], x.residual[INERTIAL_X + axis] = 0.0, 0.0
            x.away[k] += dt / LOAD_LAG * x.residual[INERTIAL_X + axis] / STANDARD_GRAVITY
            x.signals[k] = x.readings[k] - x.away[k]
    if x.excluded[AIRSPEED] != ACCEPTED:
        x.signals[AIRSPEED] = math.sqrt(
            (n.velocity[0] - n.wind[0]) ** 2
            + (n.velocity[1] - n.wind[1]) ** 2
            + (n.velocity[2] - n.wind[2]) ** 2
        )
    modelled(m, at, thrust, x, x.signals)
    _positions(x, dt)


@compiled
def _turning(x: IsolationState, dt: float) -> None:
    """Body rates by the changes of the attitude, lagged."""
    share = 1.0 - math.exp(-dt / TURNING_LAG)
    rates = body_rates_of(
        x.signals[ROLL],
        x.signals[PITCH],
        (
            wrapped(x.signals[ROLL] - x.euler[0]) / dt,
            wrapped(x.signals[PITCH] - x.euler[1]) / dt,
            wrapped(x.signals[YAW] - x.euler[2]) / dt,
        ),
    )
    for axis in range(3):
        x.turning[axis] += share * (rates[axis] - x.turning[axis])
        x.euler[axis] = x.signals[ROLL + axis]


@compiled
def _positions(x: IsolationState, dt: float) -> None:
    """Positions without their instrument: flown on by the velocity through the air and the wind."""
    n, s = x.navigation, x.signals
    if (
        x.excluded[NORTH] == ACCEPTED
        and x.excluded[EAST] == ACCEPTED
        and x.excluded[ALTITUDE] == ACCEPTED
    ):
        return
    air = air_velocity(s[AIRSPEED], s[ALPHA], s[SIDESLIP], s[ROLL], s[PITCH], s[YAW])
    for axis in range(3):
        k = NORTH if axis == 0 else EAST if axis == 1 else ALTITUDE
        if x.excluded[k] != ACCEPTED:
            moving = air[axis] + n.wind[axis]
            n.velocity[axis] += dt / AIR_LAG * (moving - n.velocity[axis])
            x.signals[k] += dt * (moving if axis < 2 else -moving)


@compiled
def exclude(x: IsolationState, k: int, reason: int) -> None:
    """Take instrument `k` out: what it has spoilt in the last seconds goes back to what was before.

    Args:
        x: ISOLATION, changed in place.
        k: place in SIGNALS.
        reason: not ACCEPTED.
    """
    x.excluded[k] = reason
    if reason == DISAGREES:  # two that stand in for one another: the first decision was wrong
        other = LOAD_Z if k == ALPHA else ALPHA if k == LOAD_Z else -1
        other = LOAD_Y if k == SIDESLIP else SIDESLIP if k == LOAD_Y else other
        if other >= 0 and x.excluded[other] == DISAGREES:
            x.excluded[other] = ACCEPTED
    x.agrees[k], x.apart[k], x.out[k] = 0.0, FAR, 0.0
    x.away[k] = x.amplitude[k] if reason == DISAGREES else 0.0
    n, w = x.navigation, x.windows
    if w.count > 0:
        oldest = w.next if w.count >= LONGEST else 0
        for axis in range(3):
            n.wind[axis] = w.winds[oldest, axis]
        if reason == DISAGREES:
            x.before = w.estimates[oldest]
    if LOAD_X <= k <= LOAD_Z:
        n.acceleration[k - LOAD_X] = 0.0
        x.wait = SETTLED
    elif ROLL_RATE <= k <= YAW_RATE:
        for axis in range(3):  # which the wrong rate has turned
            n.attitude[axis], n.steady[axis] = x.euler[axis], x.euler[axis]
        x.wait = SETTLED
    elif ROLL <= k <= YAW:
        for axis in range(3):  # which the wrong attitude has drawn
            n.attitude[axis] = n.steady[axis]
        x.wait = SETTLED
