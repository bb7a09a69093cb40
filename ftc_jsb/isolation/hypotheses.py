"""Who it was: generalised likelihood ratios of every fault over every span, and their probabilities.

A fault of unknown size a that began a span ago moves the residuals' means d by a times its signature s. With
independent means of variance V the logarithm of the likelihood ratio against "nothing is wrong", at the size
that fits best, is (sum s d / V)^2 / (2 sum s^2 / V) (Willsky and Jones 1976); faults of impossible sizes are
held back by adding 1 / size^2 below. The span in which it is the largest says
since when; probabilities are those of Bayes over that span.
"""

import math

from ftc_jsb.compiled import compiled
from ftc_jsb.isolation.navigation import GYRO_SETTLING, SETTLING
from ftc_jsb.isolation.records import (
    AIR_X,
    BLOCK,
    COUNT,
    DRIFT_ROW,
    FORCE,
    GYRO_X,
    LIFT,
    RESIDUALS,
    ROWS,
    SPANS,
    THRUST_ROW,
)
from ftc_jsb.isolation.redundancy import ELEVATOR, ROLL, RUDDER, YAW
from ftc_jsb.isolation.windows import look_back, variance
from ftc_jsb.vocabulary.hypotheses import FIRST_INSTRUMENT, HYPOTHESES, THRUST_LOSS, UNKNOWN
from ftc_jsb.vocabulary.kernel_types import IsolationSettings, IsolationState

THRUST_ODDS = 20.0  # an engine fails so many times as often as an instrument of a suite
PICK_OFF_ODDS = 0.1
ATTITUDE_ODDS = 0.02  # that does not jump, which is noticed otherwise
UNKNOWN_ODDS = 0.001  # that something else fails, which may move all residuals at once
FREEDOM = 10.0  # log likelihood that any residuals gain by being explained one by one


@compiled
def weigh(s: IsolationSettings, x: IsolationState) -> None:
    """Log likelihood ratios of every hypothesis over the span that tells most, to `x.likelihood`."""
    w = x.windows
    best, most = 0.0, -1
    x.unexplained = 0.0
    for span in range(len(SPANS)):
        if w.count < SPANS[span]:
            break
        look_back(w, span)
        greatest = 0.0
        for row in range(ROWS):
            greatest = max(greatest, likelihood_ratio(s, x, span, row))
        if greatest > best:
            best, most = greatest, span
    x.statistic = best / s.threshold
    for row in range(ROWS):
        x.likelihood[row] = likelihood_ratio(s, x, most, row) if most >= 0 else 0.0
    if most >= 0:
        x.unexplained = -best
        for k in range(RESIDUALS):
            x.unexplained += 0.5 * w.means[most, k] ** 2 / variance(s, w, most, k)


@compiled
def likelihood_ratio(s: IsolationSettings, x: IsolationState, span: int, row: int) -> float:
    """Logarithm of it, for the fault of a row that began `SPANS[span]` blocks ago."""
    if row < COUNT and x.excluded[row] != 0:
        return 0.0
    if DRIFT_ROW <= row < THRUST_ROW and x.excluded[ROLL + row - DRIFT_ROW] != 0:
        return 0.0
    w = x.windows
    along, square = 0.0, 0.0
    for k in range(RESIDUALS):
        if row == THRUST_ROW and k == FORCE:  # what was lost is a share of what was asked for
            expected = -w.mean_thrust[span]
        else:
            expected = x.signature[row, k] * _come(row, k, SPANS[span] * BLOCK)
        if expected != 0.0:
            v = variance(s, w, span, k)
            along += expected * w.means[span, k] / v
            square += expected * expected / v
    if square == 0.0 or (row == THRUST_ROW and along < 0.0):
        return 0.0
    square += 1.0 / s.sizes[row] ** 2
    x.amplitude[row] = along / square
    return float(0.5 * along * along / square)


@compiled
def _come(row: int, k: int, seconds: float) -> float:
    """How much of a lasting signature the mean over the time since the fault has.

    Positions and gyros tell it through observers. An attitude that has jumped turns once, one that drifts
    all the time.
    """
    attitude, drifting = ROLL <= row <= YAW, DRIFT_ROW <= row < THRUST_ROW
    x = seconds / GYRO_SETTLING
    if GYRO_X <= k < LIFT:
        if attitude:
            return (1.0 - math.exp(-x)) / seconds
        risen = 1.0 - (1.0 - math.exp(-x)) / x
        return risen / seconds if drifting else risen
    share = 0.5 if drifting else 1.0  # of a drift the mean is half of what has come about
    if k < AIR_X:
        y = seconds / SETTLING
        decayed = 3.0 - math.exp(-y) * (3.0 + 2.0 * y + 0.5 * y * y)
        share *= 1.0 - decayed / y
    return share


@compiled
def judge(x: IsolationState) -> int:
    """Probabilities of all hypotheses, to `x.probabilities`; the place of the most probable one."""
    total = 0.0
    for h in range(len(HYPOTHESES)):
        x.probabilities[h] = 0.0
    largest = 0.0
    for row in range(ROWS):
        largest = max(largest, x.likelihood[row])
    for row in range(ROWS):
        h, odds = THRUST_LOSS, THRUST_ODDS
        if row < COUNT:
            h = FIRST_INSTRUMENT + row
            pick_off, attitude = ELEVATOR <= row <= RUDDER, ROLL <= row <= YAW
            odds = PICK_OFF_ODDS if pick_off else ATTITUDE_ODDS if attitude else 1.0
        elif row < THRUST_ROW:
            h, odds = FIRST_INSTRUMENT + ROLL + row - DRIFT_ROW, ATTITUDE_ODDS
        x.probabilities[h] += odds * math.exp(x.likelihood[row] - largest)
    x.probabilities[UNKNOWN] = UNKNOWN_ODDS * math.exp(min(x.unexplained - FREEDOM, 50.0))
    for h in range(1, len(HYPOTHESES)):
        total += x.probabilities[h]
    winner = 1
    for h in range(1, len(HYPOTHESES)):
        x.probabilities[h] /= total
        if x.probabilities[h] > x.probabilities[winner]:
            winner = h
    return winner
