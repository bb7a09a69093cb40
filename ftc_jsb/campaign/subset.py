"""Probability of a rare event by subset simulation (Au and Beck 2001), with its coefficient of variation.

The event is "the objective is below a threshold". Levels of ever lower thresholds, each reached by a part
of the samples, are sampled by Markov chains from those that reached the one before.
"""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.special import ndtr

Array = npt.NDArray[np.float64]
Objective = Callable[[Array], Sequence[float]]
_SPREAD = 1.0  # standard deviation of a step, in standard normal coordinates


class Level(NamedTuple):
    """One level of a subset simulation."""

    threshold: float  # of the objective
    probability: float  # of being below it, given the level before
    variation: float  # coefficient of variation of that


class SubsetResult(NamedTuple):
    """Probability of the event."""

    probability: float
    coefficient_of_variation: float
    levels: tuple[Level, ...]
    evaluations: int


def subset_simulation(
    objective: Objective,
    dimensions: int,
    *,
    samples: int = 500,
    level_probability: float = 0.1,
    levels: int = 8,
    threshold: float = 0.0,
    seed: int = 0,
) -> SubsetResult:
    """Estimate the probability that `objective` is below `threshold` on the unit cube.

    Args:
        objective: takes (k, dimensions) in [0, 1], gives k numbers.
        dimensions: of the cube.
        samples: a level.
        level_probability: part of the samples that reaches the next level.
        levels: at most; beyond, the probability is below what was reached.
        threshold: of the event.
        seed: of the chains.
    """
    random = np.random.default_rng(seed)
    chains = max(round(samples * level_probability), 2)
    length = math.ceil(samples / chains)
    points = random.standard_normal((chains * length, dimensions))
    values = np.asarray(objective(ndtr(points)), dtype=float)
    evaluations, probability, found = values.size, 1.0, []
    for number in range(levels):
        # Chains stand in columns of `length`: how samples of one chain depend on each other
        reached = max(float(np.sort(values)[chains - 1]), threshold)
        below = values <= reached if reached > threshold else values < threshold
        share = float(below.mean())
        found.append(Level(reached, share, _variation(below, share, length if number else 1)))
        probability *= share
        if reached <= threshold or share == 0.0 or number == levels - 1:
            break
        seeds = np.flatnonzero(below)[np.argsort(values[below], kind="stable")][:chains]
        points, values, spent = _chains(
            objective, points[seeds], values[seeds], length, reached, random
        )
        evaluations += spent
    variation = math.sqrt(sum(level.variation**2 for level in found))
    return SubsetResult(probability, variation, tuple(found), evaluations)


def _chains(
    objective: Objective,
    points: Array,
    values: Array,
    length: int,
    reached: float,
    random: np.random.Generator,
) -> tuple[Array, Array, int]:
    """Modified Metropolis from each seed, all chains at once; chains one after the other in the result.

    Args:
        objective: as above.
        points, values: (chains, dimensions), (chains,) to start from.
        length: samples of each chain, the first one included.
        reached: a sample must stay below it.
        random: of the steps.
    """
    all_points, all_values, spent = [points], [values], 0
    for _ in range(length - 1):
        step = points + _SPREAD * random.standard_normal(points.shape)
        ratio = np.exp(0.5 * (points**2 - step**2))  # of standard normal densities, each coordinate
        candidate = np.where(random.random(points.shape) < ratio, step, points)
        candidate_values = np.asarray(objective(ndtr(candidate)), dtype=float)
        spent += candidate_values.size
        accepted = candidate_values <= reached
        points = np.where(accepted[:, None], candidate, points)
        values = np.where(accepted, candidate_values, values)
        all_points.append(points)
        all_values.append(values)
    stacked = np.stack(all_points, axis=1).reshape(-1, points.shape[1])
    return stacked, np.stack(all_values, axis=1).ravel(), spent


def _variation(below: npt.NDArray[np.bool_], share: float, length: int) -> float:
    """Coefficient of variation of a level's probability, with chains of `length` (Au and Beck, 28 and 29)."""
    count = below.size
    if share in (0.0, 1.0):
        return 0.0 if share else math.inf
    plain = (1.0 - share) / (share * count)
    if length == 1:
        return math.sqrt(plain)
    rows = below.reshape(-1, length).astype(float)
    variance = share * (1.0 - share)
    correlation = 0.0
    for lag in range(1, length):
        together = float(np.mean(rows[:, :-lag] * rows[:, lag:]))
        correlation += 2.0 * (1.0 - lag / length) * (together - share**2) / variance
    return math.sqrt(plain * (1.0 + max(correlation, 0.0)))
