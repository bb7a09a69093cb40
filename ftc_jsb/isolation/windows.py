"""Means of the residuals over the last seconds, less what they were before, and their variances."""

import math

from ftc_jsb.compiled import compiled
from ftc_jsb.isolation.records import AIR_X, FORCE, LIFT, LONGEST, RESIDUALS, SIDE, SPANS
from ftc_jsb.units import STANDARD_GRAVITY
from ftc_jsb.vocabulary.kernel_types import IsolationSettings, Vector, Windows

MEMORY = 300.0  # blocks of the baseline
PRIOR = 20.0  # blocks that what is known before the flight is worth
GUST_MEMORY = 100.0  # blocks
GUST_STEP = 10  # blocks: a second, over which the air changes by gusts alone
GUST_CHANGE = 2.6  # [m^2/s^2]: square of that change in moderate turbulence, one axis
WIND_VARIANCE = 2.0  # [m^2/s^2]: of the lasting wind at the start, in moderate turbulence
TRANSIENT_SHARE = 0.3  # of a change of thrust: what a model of the engine may be off by meanwhile
TRANSIENT_LAG = 3.0  # blocks
SLIP_CALM = math.radians(0.03)  # what the sideslip that makes drag may be off by
SLIP_GUST = math.radians(0.05)  # and in moderate turbulence
BENT = 0.5  # of g times an angle that is wrong: what its drag may be off by
UNLIKE = 0.003  # of a load factor: attitude, alignment and the Earth's turning, in another attitude
PULL_MEMORY = 100.0  # blocks
INEXACT = 0.1  # of a residual: what its signature may be off by


@compiled
def empty_windows(w: Windows) -> None:
    """Nothing seen, moderate turbulence."""
    w.filled, w.next, w.count, w.learned = 0, 0, 0, 0
    w.gust, w.pull = 1.0, 0.0
    w.thrust, w.transient = math.nan, 0.0
    for k in range(RESIDUALS):
        w.total[k], w.baseline[k], w.biased[k] = 0.0, 0.0, 0.0


@compiled
def begin_anew(w: Windows) -> None:
    """Forget what the ring holds, which somebody's fault is in; the baseline is older and stays."""
    w.next, w.count = 0, 0


@compiled
def add_block(w: Windows, wind: Vector, effectiveness: float, thrust: float, doubt: float) -> None:
    """The block that is full goes into the ring, the oldest into the baseline.

    Args:
        w: WINDOWS, changed in place.
        wind: (3,), lasting [m/s].
        effectiveness: of thrust, as estimated.
        thrust: of the model over mass [m/s^2].
        doubt: what it may be off by while the engine spools [m/s^2].
    """
    for k in range(RESIDUALS):
        w.total[k] /= w.filled
    place = w.next
    if w.count >= LONGEST:
        share = max(1.0 / MEMORY, 1.0 / (w.learned + 1.0 + PRIOR))
        for k in range(RESIDUALS):
            w.baseline[k] += share * (w.blocks[place, k] - w.baseline[k])
        w.learned += 1
    if w.count >= GUST_STEP:
        _feel_gusts(w, place)
    for k in range(RESIDUALS):
        w.blocks[place, k] = w.total[k]
        w.total[k] = 0.0
    for k in range(3):
        w.winds[place, k] = wind[k]
    w.estimates[place] = effectiveness
    w.thrusts[place], w.doubts[place] = thrust, doubt
    w.filled = 0
    w.next = (place + 1) % LONGEST
    w.count += 1
    if not math.isfinite(w.thrust):
        w.thrust = thrust
    w.thrust += (thrust - w.thrust) / TRANSIENT_LAG
    w.transient = max(0.7 * w.transient, abs(thrust - w.thrust))


@compiled
def feel_load(w: Windows, load_factor: float) -> None:
    """The largest load factor of the last ten seconds or so, beside 1; once a block."""
    w.pull = max(w.pull * (1.0 - 1.0 / PULL_MEMORY), abs(load_factor - 1.0))


@compiled
def _feel_gusts(w: Windows, place: int) -> None:
    """Power of the turbulence, by what the air has changed in a second; one change counts for 9 at most."""
    before = (place - GUST_STEP + LONGEST) % LONGEST
    power = 0.0
    for k in range(AIR_X, AIR_X + 3):
        change = w.total[k] - w.blocks[before, k]
        power += min(change * change, 9.0 * max(w.gust, 0.05) * GUST_CHANGE) / 3.0
    w.gust += (power / GUST_CHANGE - w.gust) / GUST_MEMORY


@compiled
def look_back(w: Windows, span: int) -> None:
    """Means over the last blocks of a span: residuals less their baseline to `w.means`, and thrust."""
    blocks = SPANS[span]
    for k in range(RESIDUALS):
        total = 0.0
        for b in range(1, blocks + 1):
            total += w.blocks[(w.next - b + LONGEST) % LONGEST, k]
        w.means[span, k] = total / blocks - w.baseline[k]
    thrust, doubt = 0.0, 0.0
    for b in range(1, blocks + 1):
        place = (w.next - b + LONGEST) % LONGEST
        thrust += w.thrusts[place]
        doubt += w.doubts[place]
    w.mean_thrust[span], w.mean_doubt[span] = thrust / blocks, doubt / blocks


@compiled
def variance(s: IsolationSettings, w: Windows, span: int, k: int) -> float:
    """Of a mean of residual `k` about what a fault would make it: instruments, gusts, models, the baseline.

    Signatures are of a model, too: a large residual may be off by a tenth of itself.
    """
    unknown = PRIOR / (PRIOR + w.learned)
    total = s.calm[span, k] + w.gust * s.gust[span, k] + unknown * (s.start[k] + w.biased[k])
    if k < AIR_X:
        total += (UNLIKE * STANDARD_GRAVITY * w.pull) ** 2
    if AIR_X <= k < AIR_X + 3:
        total += unknown * w.gust * WIND_VARIANCE
    elif k == FORCE:
        slipping = w.slip_drag**2 * (SLIP_CALM**2 + w.gust * SLIP_GUST**2)
        total += slipping
        if (
            w.side_slope > 0.0
        ):  # side force that is wrong tells of a sideslip that is wrong, and of its drag
            total += (w.slip_drag * w.means[span, SIDE] / w.side_slope) ** 2
        bent = BENT * STANDARD_GRAVITY * w.means[span, LIFT]
        total += (TRANSIENT_SHARE * w.transient) ** 2 + w.mean_doubt[span] ** 2 + bent * bent
    return float(total + (INEXACT * w.means[span, k]) ** 2)
