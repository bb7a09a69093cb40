"""The point of the unit cube at which an objective is least, found in few evaluations.

The objective is any Python callable: a flight of a campaign, another simulator.
"""

import contextlib
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.stats import qmc

Array = npt.NDArray[np.float64]
Objective = Callable[
    [Array], Sequence[float]
]  # (points, dimensions) in [0, 1] -> a number of each point
METHODS = ("cma-es", "differential-evolution", "random")
# Of CMA-ES, by the median of 40 synthetic defects of one class of six in ten dimensions
_STEP, _POPULATION = 0.1, 6
_NEVER = 1e6  # in place of what is not finite: nothing was learnt there


class Trace(NamedTuple):
    """Every point that was asked for, in order, and what the objective is there."""

    points: Array  # (evaluations, dimensions)
    values: Array  # (evaluations,); inf where the objective gave none

    def first_below(self, threshold: float) -> int | None:
        """Evaluations until the objective was below `threshold`; None if it never was."""
        found = np.flatnonzero(self.values < threshold)
        return int(found[0]) + 1 if found.size else None


class _SpentError(Exception):
    """The budget is used up."""


def minimise(
    objective: Objective, dimensions: int, budget: int, seed: int = 0, method: str = METHODS[0]
) -> Trace:
    """Look for the least value of `objective` over the unit cube.

    The same objective and seed give the same points.

    Args:
        objective: takes (k, dimensions), gives k numbers; nan or inf where there is none.
        dimensions: of the cube.
        budget: evaluations.
        seed: of the optimiser.
        method: one of METHODS.

    Raises:
        ValueError: an unknown method.
    """
    if method not in METHODS:
        raise ValueError(f"method: no {method!r}; expected one of {', '.join(METHODS)}")
    points: list[Array] = []
    values: list[float] = []

    def ask(wanted: Array) -> Array:
        asked = np.clip(wanted, 0.0, 1.0)[: budget - len(values)]
        found = [float(value) for value in objective(asked)]
        points.extend(asked)
        values.extend(value if np.isfinite(value) else np.inf for value in found)
        if len(values) >= budget:
            raise _SpentError
        return np.array([value if np.isfinite(value) else _NEVER for value in found])

    run: dict[str, Callable[..., None]] = {
        "cma-es": _cma_es,
        "differential-evolution": _differential_evolution,
        "random": _random,
    }
    with contextlib.suppress(_SpentError):
        run[method](ask, dimensions, seed)
    return Trace(np.array(points).reshape(len(values), dimensions), np.array(values))


def one_by_one(function: Callable[[Array], float]) -> Objective:
    """An objective of many points from one of a single point (dimensions,)."""
    return lambda points: [function(point) for point in points]


def _random(ask: Callable[[Array], Array], dimensions: int, seed: int) -> None:
    random = np.random.default_rng(seed)
    while True:
        ask(random.random((8, dimensions)))


def _first_points(dimensions: int, seed: int) -> Array:
    """Spread over the cube: a power of 2 of a Sobol sequence, some two for each dimension."""
    power = max(3, int(2 * dimensions - 1).bit_length())
    return qmc.Sobol(dimensions, rng=np.random.default_rng(seed)).random_base2(power)


def _cma_es(ask: Callable[[Array], Array], dimensions: int, seed: int) -> None:
    """CMA-ES (Hansen) by `cmaes`, begun at the best points of a spread in turn, again and again."""
    import cmaes

    while True:
        start = _first_points(dimensions, seed)
        order = np.argsort(ask(start), kind="stable")
        for place in order[:3]:
            evolution = cmaes.CMA(
                mean=start[place],
                sigma=_STEP,
                population_size=_POPULATION,
                bounds=np.tile([0.0, 1.0], (dimensions, 1)),
                seed=seed,
            )
            while not evolution.should_stop():
                asked = np.array([evolution.ask() for _ in range(evolution.population_size)])
                evolution.tell(list(zip(asked, ask(asked), strict=True)))
        seed += 1


def _differential_evolution(ask: Callable[[Array], Array], dimensions: int, seed: int) -> None:
    """SciPy's differential evolution (Storn and Price), from a spread, again and again."""
    from scipy.optimize import Bounds, differential_evolution

    def of_columns(columns: Array, /, *_: Any, **__: Any) -> Any:
        return ask(np.atleast_2d(columns.T))

    while True:
        differential_evolution(
            of_columns,
            Bounds(np.zeros(dimensions), np.ones(dimensions)),
            init=_first_points(dimensions, seed),
            mutation=(0.4, 0.9),
            rng=np.random.default_rng(seed),
            polish=False,
            vectorized=True,
            updating="deferred",
            maxiter=10_000,
        )
        seed += 1
