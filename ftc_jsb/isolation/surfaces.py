"""Servo monitor: whether a surface goes where flight control sends it, and whether its pick-off says so.

Flight control knows where a healthy actuator would be by now. A surface that has lost effectiveness, is stuck
or runs away moves otherwise, a pick-off that is wrong tells the same movement from another place: the gain from
the changes of what was commanded to the changes of what is read tells one from the other. It is found by least
squares with exponential forgetting; its log likelihood ratio against 1, and that of the offset against none,
are held against the same threshold as everything else.
"""

import math

from ftc_jsb.compiled import compiled
from ftc_jsb.isolation.records import ACCEPTED, DISAGREES, NOISY, SURFACE_COUNT
from ftc_jsb.isolation.redundancy import AILERON, ELEVATOR, RUDDER
from ftc_jsb.vocabulary.kernel_types import IsolationSettings, IsolationState, Vector

GAIN_LAG = 0.5  # [s] of the sums that the gain is found by
SINCE = 0.15  # [s], likewise, of what has changed
OFFSET_LAG = 0.1  # [s]
LASTING_LAG = 30.0  # [s] of the offset that a healthy pick-off has
LEAST_NOISE = 5e-5  # of a position [rad]: arithmetic of what is compared
LATE = 0.05  # of a change in one sample: what the two may be apart in time
LEAST_LOSS = 0.1  # of the gain: less is no fault
WELL_KNOWN = 0.1  # standard deviation of a gain that clears the surface
LEAST_OFFSET = math.radians(0.15)  # less is no fault
SOON = 0.3  # [s] for which an offset has to last
MOVES_FIRST = 0.9  # [s] in which a surface that does not obey makes the inner loop move
CLEAR = 3.0  # log likelihood ratio of a gain of 1: 20 to 1
HEALED = 2.0  # [s] for which a surface has to obey again
ROUGH = 20.0  # times the noise's power


@compiled
def pick_off_of(surface: int) -> int:
    """Place in SIGNALS of the pick-off of elevator, aileron, rudder (0, 1, 2)."""
    return ELEVATOR if surface == 0 else AILERON if surface == 1 else RUDDER


@compiled
def start_surfaces(x: IsolationState, commanded: Vector) -> None:
    """Every surface healthy, no offset."""
    for j in range(SURFACE_COUNT):
        f = x.surfaces[j]
        f.commanded, f.reading = commanded[j], math.nan
        f.due = commanded[j]
        f.square, f.product, f.rough = 0.0, 0.0, 1.0
        f.square_soon, f.product_soon = 0.0, 0.0
        f.offset, f.lasting, f.away, f.obeys = 0.0, 0.0, 0.0, 0.0
        f.gain, f.gain_std = 1.0, 1e3
        f.faulty, f.told, f.statistic = 0, 0, 0.0


@compiled
def watch_surface(
    s: IsolationSettings, x: IsolationState, j: int, commanded: float, dt: float
) -> int:
    """One sample of a surface; why its pick-off cannot be believed, ACCEPTED if it can.

    Args:
        s, x: settings and state; `surfaces[j]` is advanced, its `faulty` is 1 where the surface does not obey.
        j: 0 elevator, 1 aileron, 2 rudder.
        commanded: position that flight control has sent the surface to, by now; nan = not known.
        dt: sample time [s].
    """
    f, k = x.surfaces[j], pick_off_of(j)
    reading = x.raw[k]
    due = commanded + s.pick_off_lag[j] * (f.commanded - commanded)
    change, moved = due - f.due, reading - f.reading
    f.commanded, f.due, f.reading = commanded, due, reading
    if x.excluded[k] != ACCEPTED and x.excluded[k] != DISAGREES:  # it tells nothing of its surface
        f.square, f.product, f.square_soon, f.product_soon = 0.0, 0.0, 0.0, 0.0
        f.faulty, f.away, f.statistic = 0, 0.0, 0.0
        return ACCEPTED
    if not (math.isfinite(change) and math.isfinite(moved)):
        f.offset = reading - due if math.isfinite(reading - due) else f.offset
        return ACCEPTED
    noise = 2.0 * s.noise[k] ** 2 + LEAST_NOISE**2 + (LATE * change) ** 2
    keep = math.exp(-dt / GAIN_LAG)
    f.square = keep * f.square + change * change / noise
    f.product = keep * f.product + change * moved / noise
    soon = math.exp(-dt / SINCE)
    f.square_soon = soon * f.square_soon + change * change / noise
    f.product_soon = soon * f.product_soon + change * moved / noise
    rough = min((moved - f.gain * change) ** 2 / noise, 5.0 * ROUGH)
    f.rough += dt / GAIN_LAG * (rough - f.rough)
    f.offset += (1.0 - math.exp(-dt / OFFSET_LAG)) * (reading - due - f.offset)
    _find_gain(f)
    return _judge_surface(s, f, k, dt)


@compiled
def _find_gain(f: IsolationState) -> None:
    if f.square > 1.0:
        f.gain, f.gain_std = f.product / f.square, 1.0 / math.sqrt(f.square)
    else:
        f.gain, f.gain_std = 1.0, 1.0


@compiled
def _judge_surface(s: IsolationSettings, f: IsolationState, k: int, dt: float) -> int:
    """Whose fault it is that reading and command differ, if they do."""
    by_gain = 0.5 * ((1.0 - f.gain) / f.gain_std) ** 2 / max(f.rough, 1.0)
    obeys = abs(1.0 - f.gain) < LEAST_LOSS or by_gain < s.threshold
    if not obeys:
        f.faulty, f.obeys = 1, 0.0
    off = f.offset - f.lasting
    spread = s.noise[k] ** 2 * dt / OFFSET_LAG + s.bias[k] ** 2 + LEAST_NOISE**2
    by_offset = 0.5 * off * off / spread
    there = abs(off) > LEAST_OFFSET and by_offset > s.threshold
    f.statistic = max(
        by_gain if abs(1.0 - f.gain) > LEAST_LOSS else 0.0, by_offset if there else 0.0
    )
    f.away = f.away + dt if there else 0.0
    if f.faulty == 1:
        clear = abs(1.0 - f.gain) < LEAST_LOSS and f.gain_std < WELL_KNOWN and not there
        f.obeys = f.obeys + dt if clear else 0.0
        if f.obeys > HEALED:
            f.faulty = 0
        return ACCEPTED
    if not there:
        f.lasting += dt / LASTING_LAG * (f.offset - f.lasting)
    reason = ACCEPTED
    if f.rough > ROUGH and abs(1.0 - f.gain) < 3.0 * f.gain_std * math.sqrt(f.rough):
        reason = NOISY
    elif f.away > SOON:
        told = _by_gain(f, off, f.product_soon, f.square_soon)
        if abs(told) < CLEAR and f.away > MOVES_FIRST:
            told = math.copysign(CLEAR, _by_gain(f, off, f.product, f.square))
        if told >= CLEAR:
            reason = DISAGREES
        elif told <= -CLEAR:
            f.faulty, f.obeys = 1, 0.0
    return reason


@compiled
def _by_gain(f: IsolationState, off: float, product: float, square: float) -> float:
    """Log likelihood ratio of a gain of 1 against that of a surface that is off by so much, or stuck."""
    lost = 0.0
    if abs(f.due) > abs(off):
        lost = min(max(1.0 + off / f.due, 0.0), 1.0 - LEAST_LOSS)
    if square < 1.0:
        return 0.0
    gain = product / square
    return float(0.5 * square * (min((lost - gain) ** 2, gain**2) - (1.0 - gain) ** 2))
