"""Intervals of what is counted: probabilities, differences of pairs, rates, areas under a ROC curve."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.stats import chi2, norm, t

Array = npt.NDArray[np.float64]


class Interval(NamedTuple):
    """An estimate and its confidence interval."""

    value: float
    low: float
    high: float


def wilson(events: int, cases: int, confidence: float = 0.95) -> Interval:
    """Probability of an event, by Wilson's score interval (Wilson 1927); 0 to 1 without a case."""
    if cases == 0:
        return Interval(math.nan, 0.0, 1.0)
    z = float(norm.ppf(0.5 + 0.5 * confidence))
    p = events / cases
    scale = 1.0 + z * z / cases
    centre = (p + z * z / (2 * cases)) / scale
    half = z / scale * math.sqrt(p * (1 - p) / cases + (z / (2 * cases)) ** 2)
    return Interval(p, max(centre - half, 0.0), min(centre + half, 1.0))


def paired_probability(
    only_first: int, only_second: int, cases: int, confidence: float = 0.95
) -> Interval:
    """Difference of two probabilities on the same cases, first minus second.

    Agresti and Min (2005): Wald's interval of paired proportions with half an event added to each of the
    four cells.

    Args:
        only_first, only_second: cases on which one of both has the event.
        cases: all of them.
        confidence: of the interval.
    """
    if cases == 0:
        return Interval(math.nan, -1.0, 1.0)
    b, c, n = only_first + 0.5, only_second + 0.5, cases + 2.0
    centre = (b - c) / n
    half = float(norm.ppf(0.5 + 0.5 * confidence)) * math.sqrt(b + c - (b - c) ** 2 / n) / n
    value = (only_first - only_second) / cases
    return Interval(value, max(centre - half, -1.0), min(centre + half, 1.0))


def mean_difference(differences: Array, confidence: float = 0.95) -> Interval:
    """Mean of paired differences, by Student's t."""
    finite = differences[np.isfinite(differences)]
    if finite.size < 2:
        return Interval(float(finite.mean()) if finite.size else math.nan, -math.inf, math.inf)
    mean = float(finite.mean())
    error = float(finite.std(ddof=1)) / math.sqrt(finite.size)
    half = float(t.ppf(0.5 + 0.5 * confidence, finite.size - 1)) * error
    return Interval(mean, mean - half, mean + half)


def rate(events: int, hours: float, confidence: float = 0.95) -> Interval:
    """Events an hour: bounds that hold with `confidence` each, exact for a Poisson process (Garwood 1936).

    Without an event the upper bound is -ln(1 - confidence) / hours.
    """
    if hours <= 0.0:
        return Interval(math.nan, 0.0, math.inf)
    low = float(chi2.ppf(1.0 - confidence, 2 * events)) / 2.0 / hours if events else 0.0
    high = float(chi2.ppf(confidence, 2 * (events + 1))) / 2.0 / hours
    return Interval(events / hours, low, high)


def area_under_roc(negative: Array, positive: Array, confidence: float = 0.95) -> Interval:
    """Probability that a positive's score is above a negative's; interval by Hanley and McNeil (1982)."""
    m, n = negative.size, positive.size
    if m == 0 or n == 0:
        return Interval(math.nan, 0.0, 1.0)
    ordered = np.sort(negative)
    below = np.searchsorted(ordered, positive, "left") + np.searchsorted(ordered, positive, "right")
    area = float(below.mean()) / (2.0 * m)
    one, two = area / (2.0 - area), 2.0 * area**2 / (1.0 + area)
    spread = area * (1 - area) + (n - 1) * (one - area**2) + (m - 1) * (two - area**2)
    half = float(norm.ppf(0.5 + 0.5 * confidence)) * math.sqrt(max(spread, 0.0) / (m * n))
    return Interval(area, max(area - half, 0.0), min(area + half, 1.0))
