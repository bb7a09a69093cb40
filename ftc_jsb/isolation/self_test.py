"""What an instrument's own readings tell: silent, stale, noisy, or a jump that no gyro has felt."""

import math

from ftc_jsb.compiled import compiled
from ftc_jsb.isolation.navigation import wrapped
from ftc_jsb.isolation.records import ACCEPTED, COUNT, JUMPED, NOISY, SILENT, STALE
from ftc_jsb.isolation.redundancy import ELEVATOR, LOAD_Z, ROLL, ROLL_RATE, YAW
from ftc_jsb.vocabulary.kernel_types import IsolationSettings, IsolationState, Vector

SILENT_TIME = 0.1  # [s]
ROUGH_LAG = 0.5  # [s]
LEAST_MOST, MOST = 100.0, 2000.0  # times the noise's power: a single jump is no noise
ROUGH = 20.0  # times the noise's power
ROUGH_OF_MOTION = 400.0
ROUGH_BY_GUSTS = 10.0  # and in moderate turbulence, which shakes vanes and accelerometers
JUMP = 8.0  # standard deviations
LEAST_JUMP = math.radians(0.1)  # in USUAL: a roll quickens by 35 rad/s^2 unfelt by the gyros
USUAL = 0.01  # [s] between samples
SLOW = 0.0125  # [s]: in longer steps motion alone is as rough as noise


@compiled
def notice_readings(s: IsolationSettings, x: IsolationState, raw: Vector, dt: float) -> None:
    """Advance what is known of each instrument's own readings by one sample.

    Args:
        s, x: settings and state.
        raw: (COUNT,) readings; nan = silent.
        dt: sample time [s].
    """
    share = 1.0 - math.exp(-dt / ROUGH_LAG)
    for k in range(COUNT):
        if not math.isfinite(raw[k]):
            x.silent[k] += dt
            continue
        x.silent[k] = 0.0
        change = raw[k] - x.readings[k]
        if ROLL <= k <= YAW:
            change = wrapped(change)
        if change == 0.0:
            x.same[k] += dt
            continue
        x.same[k] = 0.0
        if s.ordinary[k] > 0.0:
            # the change of a change of independent readings has six times their variance
            power = (change - x.change[k]) ** 2 / (6.0 * s.ordinary[k] ** 2)
            most = MOST if ROLL_RATE <= k <= LOAD_Z else LEAST_MOST
            x.rough[k] += share * (min(power, most) - x.rough[k])
        x.change[k] = change
        x.readings[k] = raw[k]


@compiled
def own_fault(s: IsolationSettings, x: IsolationState, k: int, dt: float) -> int:
    """Why instrument `k` cannot be believed by its own readings, `dt` [s] apart; ACCEPTED if it can."""
    if x.silent[k] > SILENT_TIME:
        return SILENT
    without = s.noise[k] == 0.0 and (k >= ELEVATOR or x.readings[k] == 0.0)
    if x.same[k] > s.stale[k] and not without:  # what has no noise may stand still, or be nothing
        return STALE
    if s.ordinary[k] > 0.0 and dt <= SLOW:
        limit = ROUGH + ROUGH_BY_GUSTS * x.windows.gust
        if ROLL_RATE <= k <= LOAD_Z:  # an aircraft turns and pulls as suddenly as it is told to
            limit = ROUGH_OF_MOTION
        if k < ELEVATOR and x.rough[k] > limit:  # and a surface moves so
            return NOISY
    return ACCEPTED


@compiled
def attitude_jump(
    s: IsolationSettings, x: IsolationState, axis: int, reading: float, dt: float
) -> int:
    """JUMPED where roll, pitch or yaw (axis 0 to 2) has moved otherwise than the gyros turned it."""
    n = x.navigation
    far = abs(wrapped(reading - x.euler[axis] - n.moving[axis] * dt))
    rough = LEAST_JUMP * max(1.0, (dt / USUAL) ** 2) * (1.0 + x.windows.gust)
    return JUMPED if far > JUMP * math.sqrt(2.0) * s.noise[ROLL + axis] + rough else ACCEPTED
