"""Points of the unit cube that the cases of a campaign stand at.

A point depends on the campaign and on its number alone: not on who asks, in which order, or for which
other points.
"""

from functools import lru_cache

import numpy as np
import numpy.typing as npt
from scipy.stats import qmc

from ftc_jsb.campaign.schema import Campaign, grid_levels

Points = npt.NDArray[np.float64]
_POINT, _SEED, _SCRAMBLE = range(3)  # streams of random numbers


def unit_point(campaign: Campaign, number: int) -> Points:
    """(dispersions,): coordinates in [0, 1] of case `number`."""
    size = campaign.dimensions
    if campaign.sampling == "grid":
        return _grid_point(campaign, number)
    if campaign.sampling == "monte-carlo" or size == 0:
        return _stream(campaign.seed, _POINT, number).random(size)
    matrix = _matrix(campaign.sampling, campaign.count, size, campaign.seed)
    return np.asarray(matrix[number])


def drawn_seed(campaign: Campaign, number: int) -> int:
    """Seed of noise and turbulence of case `number`."""
    return int(_stream(campaign.seed, _SEED, number).integers(2**31 - 1))


def _stream(seed: int, stream: int, number: int) -> np.random.Generator:
    return np.random.default_rng(np.random.SeedSequence((seed, stream, number)))


@lru_cache(maxsize=4)
def _matrix(sampling: str, count: int, size: int, seed: int) -> Points:
    """(count, size); with more cases the first points of a Sobol sequence stay, those of a hypercube do not."""
    random = _stream(seed, _SCRAMBLE, 0)
    if sampling == "sobol":
        whole = max(int(count - 1).bit_length(), 1)  # a power of 2, as the sequence is balanced by
        return qmc.Sobol(size, scramble=True, rng=random).random_base2(whole)[:count]
    return qmc.LatinHypercube(size, rng=random).random(count)


def _grid_point(campaign: Campaign, number: int) -> Points:
    """The last dispersion varies fastest; a level of n stands at k / (n - 1), of a choice in its middle."""
    place, units = number, []
    for dispersion in reversed(campaign.dispersion):
        levels = grid_levels(dispersion)
        place, level = divmod(place, levels)
        if dispersion.values is not None:
            units.append(middle(dispersion.weights, level, levels))
        else:
            units.append(0.5 if levels == 1 else level / (levels - 1))
    if len(campaign.scenarios) > 1:
        units.append(middle(None, place, len(campaign.scenarios)))
    return np.array(units[::-1])


def middle(weights: tuple[float, ...] | None, level: int, levels: int) -> float:
    """Coordinate in the middle of the part of [0, 1] that a value of a choice has."""
    if weights is None:
        return (level + 0.5) / levels
    return (sum(weights[:level]) + 0.5 * weights[level]) / sum(weights)
