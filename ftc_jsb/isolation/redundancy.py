"""What instruments and model have to agree on, and what each instrument would do to that agreement."""

import math

from ftc_jsb.compiled import compiled
from ftc_jsb.frames import path_from_attitude
from ftc_jsb.isolation.navigation import (
    air_velocity,
    body_rates_of,
    inertial_acceleration,
    to_body,
)
from ftc_jsb.isolation.records import (
    ACCEPTED,
    AIR_X,
    COUNT,
    DRIFT_ROW,
    FORCE,
    GYRO_X,
    INERTIAL_X,
    LIFT,
    RESIDUALS,
    SIDE,
    THRUST_ROW,
)
from ftc_jsb.point_mass.drag import alpha_slope, angle_of_attack, measured_drag_coefficient
from ftc_jsb.point_mass.lift import measured_lift_coefficient
from ftc_jsb.point_mass.model import Condition, pressure_area
from ftc_jsb.point_mass.side_force import SideRates, side_force_coefficient, sideslip_of_side_force
from ftc_jsb.units import STANDARD_GRAVITY
from ftc_jsb.vocabulary.kernel_types import IsolationState, ModelRecord, Vector
from ftc_jsb.vocabulary.signals import SENSED

AIRSPEED = SENSED.index("airspeed")
ALTITUDE = SENSED.index("altitude")
ALPHA = SENSED.index("alpha")
SIDESLIP = SENSED.index("sideslip")
ROLL = SENSED.index("roll")
PITCH = SENSED.index("pitch")
YAW = SENSED.index("yaw")
ROLL_RATE = SENSED.index("roll_rate")
PITCH_RATE = SENSED.index("pitch_rate")
YAW_RATE = SENSED.index("yaw_rate")
LOAD_X = SENSED.index("load_factor_x")
LOAD_Y = SENSED.index("load_factor_y")
LOAD_Z = SENSED.index("load_factor_z")
NORTH = SENSED.index("north")
EAST = SENSED.index("east")
ELEVATOR = SENSED.index("elevator_position")
FLAP = SENSED.index("flap_position")
AILERON = SENSED.index("aileron_position")
RUDDER = SENSED.index("rudder_position")
STEP = 0.2  # of the errors that have to be reckoned with, for the differences
SLIP_STEP = 0.01  # [rad]
LEAST_SLOPE = 1e-3  # [rad], of the angle of attack over the lift coefficient


@compiled
def agreement(
    m: ModelRecord,
    at: Condition,
    thrust: float,
    sideslip: float,
    signals: Vector,
    frame: Vector,
    out: Vector,
) -> None:
    """What readings of one sample say, each of which something else says as well.

    Args:
        m, at: model of the aircraft, and at this condition.
        thrust: that a healthy engine would give [N].
        sideslip: that makes drag [rad].
        signals: (COUNT,) readings, in the order of SIGNALS.
        frame: (3,) attitude [rad] in whose axes vectors are written.
        out: (RESIDUALS,), written but for the gyros': accelerations [m/s^2], velocity through the air [m/s],
            angle of attack beyond the one that lifts so much [rad], load factor to the side, force along
            the velocity beyond thrust less drag, over mass [m/s^2].
    """
    s = signals
    roll, pitch, yaw = s[ROLL], s[PITCH], s[YAW]
    load = (s[LOAD_X], s[LOAD_Y], s[LOAD_Z])
    felt = to_body(
        frame[0], frame[1], frame[2], inertial_acceleration(load, roll, pitch, yaw, m.gravity)
    )
    moving = to_body(
        frame[0],
        frame[1],
        frame[2],
        air_velocity(s[AIRSPEED], s[ALPHA], s[SIDESLIP], roll, pitch, yaw),
    )
    for k in range(3):
        out[INERTIAL_X + k] = felt[k]
        out[AIR_X + k] = moving[k]
    airspeed = s[AIRSPEED]
    area = pressure_area(at, airspeed)
    ca, sa = math.cos(s[ALPHA]), math.sin(s[ALPHA])
    cb, sb = math.cos(s[SIDESLIP]), math.sin(s[SIDESLIP])
    out[LIFT] = beyond_lift(m, at, thrust, s, s[ALPHA])
    out[SIDE] = load[1] - side_load_factor(m, at, s)
    drag = measured_drag_coefficient(
        m,
        airspeed / at.sound_speed,
        s[ALPHA],
        abs(sideslip),
        s[ELEVATOR],
        s[FLAP],
        s[PITCH_RATE] / airspeed,
    )
    along = STANDARD_GRAVITY * (load[0] * ca * cb + load[1] * sb - load[2] * sa * cb)
    out[FORCE] = along - (thrust * ca - area * drag) / m.mass


@compiled
def signatures(
    m: ModelRecord, at: Condition, thrust: float, sizes: Vector, x: IsolationState
) -> None:
    """What a unit of each fault does to the residuals, lasting, by differences of `agreement`.

    Rows: errors of the instruments in the order of SIGNALS, where positions stand for their drift (a unit a
    second); drifts of roll, pitch and yaw (a radian that has come about); all of the thrust lost.

    Args:
        m, at, thrust: as `agreement` takes them.
        sizes: of the errors that have to be reckoned with; differences are taken over a part of them.
        x: ISOLATION; `signature` is written.
    """
    below, frame, out = x.agreement, x.frame, x.signature
    agreement(m, at, thrust, x.sideslip, x.signals, frame, below)
    agreement(m, at, thrust, abs(x.sideslip) + SLIP_STEP, x.signals, frame, out[0])
    x.windows.slip_drag = (out[0, FORCE] - below[FORCE]) / SLIP_STEP
    for j in range(COUNT):
        step = STEP * sizes[j]
        _move(m, at, thrust, x, j, -step)
        agreement(m, at, thrust, x.sideslip, x.moved, frame, below)
        _move(m, at, thrust, x, j, step)
        agreement(m, at, thrust, x.sideslip, x.moved, frame, out[j])
        for k in range(RESIDUALS):
            out[j, k] = 0.0 if GYRO_X <= k < LIFT else (out[j, k] - below[k]) / (2.0 * step)
        if j in (ALPHA, SIDESLIP):  # drag over angles bends too much to tell anything
            out[j, FORCE] = 0.0
    x.windows.side_slope = abs(out[SIDESLIP, SIDE])
    for axis in range(3):
        out[ROLL_RATE + axis, GYRO_X + axis] = 1.0
        position = NORTH if axis == 0 else EAST if axis == 1 else ALTITUDE
        sense = 1.0 if axis < 2 else -1.0
        moved = to_body(
            frame[0],
            frame[1],
            frame[2],
            (sense if axis == 0 else 0.0, sense if axis == 1 else 0.0, sense if axis == 2 else 0.0),
        )
        for k in range(RESIDUALS):
            out[position, k] = 0.0
        for k in range(3):
            out[position, AIR_X + k] = -moved[k]
        euler = (
            1.0 if axis == 0 else 0.0,
            1.0 if axis == 1 else 0.0,
            1.0 if axis == 2 else 0.0,
        )
        turned = body_rates_of(frame[0], frame[1], euler)
        for k in range(RESIDUALS):
            out[DRIFT_ROW + axis, k] = out[ROLL + axis, k]
        for k in range(3):
            out[ROLL + axis, GYRO_X + k] = -turned[k]
            out[DRIFT_ROW + axis, GYRO_X + k] = -turned[k]
    for k in range(RESIDUALS):
        out[THRUST_ROW, k] = 0.0
    out[THRUST_ROW, FORCE] = -thrust * math.cos(x.signals[ALPHA]) / m.mass


@compiled
def expect_biases(bias: Vector, x: IsolationState) -> None:
    """Variance of the residuals by what the instruments are off by all through a flight.

    Positions have none that matters, and a biased attitude turns as the true one does.

    Args:
        bias: (COUNT,) standard deviations.
        x: ISOLATION; `signature` is read, `windows.biased` is written.
    """
    for k in range(RESIDUALS):
        total = 0.0
        for j in range(COUNT):
            turning = GYRO_X <= k < LIFT and ROLL <= j <= YAW
            if j not in (ALTITUDE, NORTH, EAST) and not turning:
                total += (x.signature[j, k] * bias[j]) ** 2
        x.windows.biased[k] = total


@compiled
def _move(
    m: ModelRecord, at: Condition, thrust: float, x: IsolationState, j: int, step: float
) -> None:
    """Signals with one reading moved, and what the model makes of it, to `x.moved`."""
    for i in range(COUNT):
        x.moved[i] = x.signals[i]
    x.moved[j] += step
    modelled(m, at, thrust, x, x.moved)


@compiled
def lift_without_thrust(
    m: ModelRecord, at: Condition, thrust: float, signals: Vector, alpha: float
) -> float:
    """Lift coefficient of the load factors, at an angle of attack [rad]."""
    normal = signals[LOAD_Z] * math.cos(alpha) + signals[LOAD_X] * math.sin(alpha)
    area = pressure_area(at, signals[AIRSPEED])
    return float((normal * m.mass * STANDARD_GRAVITY - thrust * math.sin(alpha)) / area)


@compiled
def modelled_lift(m: ModelRecord, at: Condition, signals: Vector, alpha: float) -> float:
    """Lift coefficient that the model has at an angle of attack [rad]; nan where only its inverse is known."""
    if m.measured_lift_count == 0:
        return math.nan
    s = signals
    airspeed = s[AIRSPEED]
    path, _, bank = path_from_attitude(alpha, s[SIDESLIP], s[ROLL], s[PITCH])
    normal = s[LOAD_Z] * math.cos(alpha) + s[LOAD_X] * math.sin(alpha)
    turning = m.gravity / airspeed * (normal - math.cos(path) * math.cos(bank))
    mach, per = airspeed / at.sound_speed, 1.0 / airspeed
    return float(
        measured_lift_coefficient(
            m, mach, alpha, s[ELEVATOR], s[FLAP], s[PITCH_RATE] * per, turning * per
        )
    )


@compiled
def beyond_lift(
    m: ModelRecord, at: Condition, thrust: float, signals: Vector, alpha: float
) -> float:
    """Angle of attack [rad] beyond the one that lifts what the accelerometers feel."""
    felt = lift_without_thrust(m, at, thrust, signals, alpha)
    modelled = modelled_lift(m, at, signals, alpha)
    if math.isfinite(modelled):
        return float((modelled - felt) * alpha_slope(at, felt))
    return float(alpha - angle_of_attack(at, felt))


@compiled
def lifting_alpha(m: ModelRecord, at: Condition, thrust: float, signals: Vector) -> float:
    """Angle of attack [rad] that lifts what the accelerometers feel."""
    alpha = signals[ALPHA]
    for _ in range(3):
        alpha -= beyond_lift(m, at, thrust, signals, alpha)
    return float(alpha)


@compiled
def load_factor_of_lift(
    m: ModelRecord, at: Condition, thrust: float, signals: Vector, off: float
) -> float:
    """Load factor z of the lift at the measured angle of attack, which is `off` [rad] too large."""
    alpha = signals[ALPHA]
    area = pressure_area(at, signals[AIRSPEED])
    lift = modelled_lift(m, at, signals, alpha - off)
    if not math.isfinite(lift):
        lift = lift_without_thrust(m, at, thrust, signals, alpha)
        for _ in range(3):
            slope = max(alpha_slope(at, lift), LEAST_SLOPE)
            lift += (alpha - off - angle_of_attack(at, lift)) / slope
    normal = (lift * area + thrust * math.sin(alpha)) / (m.mass * STANDARD_GRAVITY)
    return float((normal - signals[LOAD_X] * math.sin(alpha)) / math.cos(alpha))


@compiled
def _side_rates(signals: Vector) -> SideRates:
    s, airspeed = signals, signals[AIRSPEED]
    return SideRates(s[ROLL_RATE] / airspeed, s[YAW_RATE] / airspeed, s[AILERON], s[RUDDER])


@compiled
def side_load_factor(m: ModelRecord, at: Condition, signals: Vector) -> float:
    """Load factor to the side that the model has at the measured sideslip; 0 where it knows none."""
    if m.side_force_count == 0:
        return 0.0
    s = signals
    mach = s[AIRSPEED] / at.sound_speed
    force = side_force_coefficient(m, mach, s[ALPHA], s[SIDESLIP], _side_rates(s))
    return float(force * pressure_area(at, s[AIRSPEED]) / (m.mass * STANDARD_GRAVITY))


@compiled
def sideslip_of_load_factor(m: ModelRecord, at: Condition, signals: Vector) -> float:
    """Sideslip [rad] that the load factor to the side tells of; 0 where the model does not know it."""
    if m.side_force_count == 0:
        return 0.0
    s = signals
    area = pressure_area(at, s[AIRSPEED])
    force = s[LOAD_Y] * m.mass * STANDARD_GRAVITY / area
    mach = s[AIRSPEED] / at.sound_speed
    return float(sideslip_of_side_force(m, mach, s[ALPHA], force, _side_rates(s)).angle)


@compiled
def modelled(
    m: ModelRecord, at: Condition, thrust: float, x: IsolationState, signals: Vector
) -> None:
    """Signals that the model tells where their instruments are excluded: alpha, sideslip, load factor z.

    Args:
        m, at, thrust: as `agreement` takes them.
        x: ISOLATION; who is excluded.
        signals: (COUNT,), changed in place.
    """
    if x.excluded[ALPHA] != ACCEPTED:
        signals[ALPHA] = lifting_alpha(m, at, thrust, signals) + x.windows.baseline[LIFT]
    elif x.excluded[LOAD_Z] != ACCEPTED:
        off = x.windows.baseline[LIFT]
        signals[LOAD_Z] = load_factor_of_lift(m, at, thrust, signals, off)
    if x.excluded[LOAD_Y] != ACCEPTED and m.side_force_count > 0:
        signals[LOAD_Y] = side_load_factor(m, at, signals)
    if x.excluded[SIDESLIP] != ACCEPTED:
        signals[SIDESLIP] = sideslip_of_load_factor(m, at, signals)
