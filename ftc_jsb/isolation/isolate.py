"""One sample of the isolation: accept readings, see that they agree, decide whose fault it is, exclude."""

import math

from ftc_jsb.compiled import compiled
from ftc_jsb.isolation.hypotheses import judge, weigh
from ftc_jsb.isolation.navigation import (
    air_velocity,
    euler_rates,
    inertial_acceleration,
    learn_wind,
    navigate,
    start_navigation,
    to_body,
    turn_by_gyros,
    wrapped,
)
from ftc_jsb.isolation.records import (
    ACCEPTED,
    AIR_X,
    BLOCK,
    COUNT,
    DISAGREES,
    GYRO_X,
    INERTIAL_X,
    LIFT,
    RESIDUALS,
    SILENT,
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
    PITCH_RATE,
    ROLL,
    ROLL_RATE,
    SIDESLIP,
    YAW,
    YAW_RATE,
    agreement,
    expect_biases,
    sideslip_of_load_factor,
    signatures,
)
from ftc_jsb.isolation.replacement import accept, exclude
from ftc_jsb.isolation.self_test import attitude_jump, notice_readings, own_fault
from ftc_jsb.isolation.surfaces import pick_off_of, start_surfaces, watch_surface
from ftc_jsb.isolation.windows import add_block, begin_anew, empty_windows, feel_load
from ftc_jsb.point_mass.model import Condition
from ftc_jsb.vocabulary.hypotheses import (
    FIRST_INSTRUMENT,
    FIRST_SURFACE,
    NOBODY,
    THRUST_LOSS,
    UNKNOWN,
)
from ftc_jsb.vocabulary.kernel_types import (
    IsolationSettings,
    IsolationState,
    ModelRecord,
    Vector,
)

SURE = 0.95  # probability of one hypothesis
SURE_OF_THRUST = 0.9  # nothing is excluded by it
CONFIRMED = 6.0  # [s] since a loss of thrust: positions have long told of accelerometers
LONG = 2.0  # [s]: then the most probable one has to do
RECOVERY = 2.0  # [s] of the effectiveness after an instrument's fault
APART_LAG = 3.0  # [s]
SETTLING = 5.0  # [s] at the start, until position and wind are known
SIDESLIP_LAG = 0.05  # [s]
AGREED = 5.0  # [s] for which a reading has to agree again


@compiled
def start_isolation(x: IsolationState, raw: Vector) -> None:
    """Everybody accepted, nobody suspect."""
    empty_windows(x.windows)
    start_surfaces(x, x.commanded)
    for k in range(COUNT):
        value = raw[k] if math.isfinite(raw[k]) else 0.0
        x.signals[k], x.readings[k] = value, value
        x.change[k], x.rough[k], x.same[k], x.silent[k] = 0.0, 1.0, 0.0, 0.0
        x.excluded[k], x.away[k], x.agrees[k] = ACCEPTED, 0.0, 0.0
    for axis in range(3):
        x.euler[axis] = x.signals[ROLL + axis]
        x.turning[axis] = x.signals[ROLL_RATE + axis]
    y = x.signals
    attitude = (y[ROLL], y[PITCH], y[YAW])
    velocity = air_velocity(y[AIRSPEED], y[ALPHA], y[SIDESLIP], y[ROLL], y[PITCH], y[YAW])
    start_navigation(x.navigation, (y[NORTH], y[EAST], -y[ALTITUDE]), velocity, attitude)
    for k in range(RESIDUALS):
        x.residual[k] = 0.0
    x.statistic, x.ambiguous, x.quiet = 0.0, 0.0, 0.0
    x.sideslip = x.signals[SIDESLIP]
    x.wait, x.before = SETTLING, math.nan
    x.suspect, x.probability = NOBODY, 1.0
    x.thrust, x.effectiveness, x.since = 0, 1.0, 0.0


@compiled
def restart_isolation(x: IsolationState, raw: Vector) -> None:
    """`start_isolation` in flight: the aircraft turns, and what is known of the thrust stays."""
    thrust, effectiveness, since = x.thrust, x.effectiveness, x.since
    start_isolation(x, raw)
    x.thrust, x.effectiveness, x.since = thrust, effectiveness, since
    n, rates = x.navigation, (x.turning[0], x.turning[1], x.turning[2])
    moving = euler_rates(x.euler[0], x.euler[1], rates)
    for axis in range(3):
        n.rates[axis], n.moving[axis] = rates[axis], moving[axis]
    if thrust == 1:
        x.suspect = THRUST_LOSS


@compiled
def isolate(
    s: IsolationSettings,
    m: ModelRecord,
    at: Condition,
    x: IsolationState,
    raw: Vector,
    thrust: float,
    doubt: float,
    effectiveness: float,
    dt: float,
) -> None:
    """One sample.

    Args:
        s: settings.
        m, at: model of the aircraft, and at this condition.
        x: state; `signals` is then what may be believed, `suspect` who may not.
        raw: (COUNT,) readings; nan = silent.
        thrust: that the engine is believed to give [N].
        doubt: what that may be off by while it spools [N].
        effectiveness: of thrust, as estimated.
        dt: sample time [s].
    """
    for axis in range(3):
        k = ROLL + axis
        if x.excluded[k] == ACCEPTED and math.isfinite(raw[k]):
            reason = attitude_jump(s, x, axis, raw[k], dt)
            if reason != ACCEPTED:
                _take_out(x, k, reason, 1.0)
    notice_readings(s, x, raw, dt)
    for k in range(COUNT):
        if x.excluded[k] == ACCEPTED:
            reason = own_fault(s, x, k, dt)
            if reason != ACCEPTED:
                _take_out(x, k, reason, 1.0)
    for j in range(SURFACE_COUNT):
        reason, k = watch_surface(s, x, j, x.commanded[j], dt), pick_off_of(j)
        if reason != ACCEPTED and x.excluded[k] == ACCEPTED:
            _take_out(x, k, reason, 1.0)
    accept(m, at, thrust, x, raw, dt)
    _see_residuals(s, m, at, x, thrust, dt)
    x.quiet = max(x.quiet - dt, 0.0)
    _readmit(s, x, raw, dt)
    w = x.windows
    if x.wait > 0.0:
        x.wait -= dt
        return
    for k in range(RESIDUALS):
        w.total[k] += x.residual[k]
    w.filled += 1
    if w.filled * dt > BLOCK - 0.5 * dt:
        add_block(w, x.navigation.wind, effectiveness, thrust / m.mass, doubt / m.mass)
        feel_load(w, x.signals[LOAD_Z])
        signatures(m, at, thrust, s.sizes, x)
        expect_biases(s.bias, x)
        weigh(s, x)
        _decide(s, x)


@compiled
def _see_residuals(
    s: IsolationSettings,
    m: ModelRecord,
    at: Condition,
    x: IsolationState,
    thrust: float,
    dt: float,
) -> None:
    """Residuals of this sample; navigation is advanced."""
    y, n, now = x.signals, x.navigation, x.agreement
    roll, pitch, yaw = y[ROLL], y[PITCH], y[YAW]
    x.frame[0], x.frame[1], x.frame[2] = roll, pitch, yaw
    _find_sideslip(m, at, x, dt)
    agreement(m, at, thrust, x.sideslip, y, x.frame, now)
    load = (y[LOAD_X], y[LOAD_Y], y[LOAD_Z])
    felt = inertial_acceleration(load, roll, pitch, yaw, m.gravity)
    north = y[NORTH] if x.excluded[NORTH] == ACCEPTED else math.nan
    east = y[EAST] if x.excluded[EAST] == ACCEPTED else math.nan
    down = -y[ALTITUDE] if x.excluded[ALTITUDE] == ACCEPTED else math.nan
    navigate(n, felt, (roll, pitch, yaw), (north, east, down), s.position_lag, dt)
    rates = (y[ROLL_RATE], y[PITCH_RATE], y[YAW_RATE])
    gyros = turn_by_gyros(n, rates, (roll, pitch, yaw), s.gyro_lead, dt)
    air = air_velocity(y[AIRSPEED], y[ALPHA], y[SIDESLIP], roll, pitch, yaw)
    learn_wind(n, air, dt)
    through = to_body(
        roll,
        pitch,
        yaw,
        (
            air[0] + n.wind[0] - n.velocity[0],
            air[1] + n.wind[1] - n.velocity[1],
            air[2] + n.wind[2] - n.velocity[2],
        ),
    )
    alone = _gyro_excluded(x)
    for k in range(3):
        x.residual[INERTIAL_X + k] = -n.acceleration[k]
        x.residual[AIR_X + k] = through[k]
        # The attitude, which an excluded gyro's stand-in comes from, cannot judge the others as well
        x.residual[GYRO_X + k] = 0.0 if alone else gyros[k]
    for k in range(LIFT, RESIDUALS):
        x.residual[k] = now[k]


@compiled
def _find_sideslip(m: ModelRecord, at: Condition, x: IsolationState, dt: float) -> None:
    """Sideslip that makes drag: of the side force, lagged, as noise has a magnitude; else the vane's."""
    now = x.signals[SIDESLIP]
    if m.side_force_count > 0:
        now = sideslip_of_load_factor(m, at, x.signals)
    x.sideslip += (1.0 - math.exp(-dt / SIDESLIP_LAG)) * (now - x.sideslip)


@compiled
def _gyro_excluded(x: IsolationState) -> bool:
    for k in range(ROLL_RATE, YAW_RATE + 1):
        if x.excluded[k] != ACCEPTED:
            return True
    return False


@compiled
def _decide(s: IsolationSettings, x: IsolationState) -> None:
    """Suspect, declare, exclude: at once who stands out, after a while who is the most probable."""
    if x.statistic <= 1.0:
        x.ambiguous = 0.0
        if x.quiet == 0.0:
            _say_what_lasts(s, x)
        return
    winner = judge(x)
    probability = x.probabilities[winner]
    x.ambiguous += BLOCK
    sure = SURE_OF_THRUST if winner == THRUST_LOSS else SURE
    if (probability < sure or winner == UNKNOWN) and x.ambiguous < LONG:
        if x.suspect == NOBODY and winner != UNKNOWN:
            x.suspect, x.probability = winner, probability
        return
    x.ambiguous = 0.0
    x.suspect, x.probability = winner, probability
    if winner == THRUST_LOSS:
        x.thrust = 1
    elif winner < FIRST_SURFACE:
        x.thrust = 0
        _take_out(x, winner - FIRST_INSTRUMENT, DISAGREES, probability)


@compiled
def confirm_thrust(x: IsolationState, effectiveness: float, dt: float) -> None:
    """Count on the thrust that is estimated to be left, once a loss has been declared long enough.

    Until then the force along the velocity is weighed against the thrust of before, so that an
    accelerometer can still be found out.

    Args:
        x: ISOLATION.
        effectiveness: of the thrust, as estimated.
        dt: sample time [s].
    """
    if x.thrust == 0:
        x.since = 0.0
        return
    x.since += dt
    if x.since > CONFIRMED:
        if x.since <= CONFIRMED + dt:
            begin_anew(x.windows)
        x.effectiveness = effectiveness


@compiled
def _take_out(x: IsolationState, k: int, reason: int, probability: float) -> None:
    exclude(x, k, reason)
    begin_anew(x.windows)
    x.suspect, x.probability = FIRST_INSTRUMENT + k, probability
    x.quiet = RECOVERY


@compiled
def _say_what_lasts(s: IsolationSettings, x: IsolationState) -> None:
    """Nobody new is suspect: a surface that does not obey, who is excluded, thrust that is lost, or nobody."""
    for j in range(SURFACE_COUNT):
        surface = x.surfaces[j]
        if surface.faulty == 1 and surface.told == 0:
            x.suspect = FIRST_SURFACE + j
            x.probability = 1.0 - (1.0 - SURE) * math.exp(min(s.threshold - surface.statistic, 0.0))
        surface.told = surface.faulty
    if x.suspect == THRUST_LOSS and x.thrust == 1:
        return
    if FIRST_INSTRUMENT <= x.suspect < FIRST_SURFACE and x.excluded[x.suspect - FIRST_INSTRUMENT]:
        return
    if FIRST_SURFACE <= x.suspect < UNKNOWN and x.surfaces[x.suspect - FIRST_SURFACE].faulty == 1:
        return
    x.suspect, x.probability = NOBODY, 1.0
    for j in range(SURFACE_COUNT):
        if x.surfaces[j].faulty == 1:
            x.suspect = FIRST_SURFACE + j
    for k in range(COUNT):
        if x.excluded[k] != ACCEPTED:
            x.suspect = FIRST_INSTRUMENT + k
    if x.suspect == NOBODY and x.thrust == 1:
        x.suspect = THRUST_LOSS


@compiled
def _readmit(s: IsolationSettings, x: IsolationState, raw: Vector, dt: float) -> None:
    """Instruments that have agreed again for a while, by their own readings and with what stood in for them."""
    for k in range(COUNT):
        if x.excluded[k] == ACCEPTED:
            continue
        if math.isfinite(raw[k]):
            apart = raw[k] - x.signals[k]
            if ROLL <= k <= YAW:
                apart = wrapped(apart)
            x.apart[k] += dt / APART_LAG * (apart - x.apart[k])
        back = x.excluded[k] == SILENT or abs(x.apart[k]) < s.tolerance[k]
        agrees = back and math.isfinite(raw[k]) and own_fault(s, x, k, dt) == ACCEPTED
        x.agrees[k] = x.agrees[k] + dt if agrees else 0.0
        if x.agrees[k] > AGREED:
            x.excluded[k] = ACCEPTED
            begin_anew(x.windows)
