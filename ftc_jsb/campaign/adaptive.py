"""Campaigns whose next cases depend on the ones before: the search for the worst, and rare events.

They are taken up again as any other: the same questions are asked again, and those that were answered are
not flown.
"""

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.campaign.case import Bases
from ftc_jsb.campaign.engine import Engine
from ftc_jsb.campaign.flights import Batch, Item, Row
from ftc_jsb.campaign.parquet import writing
from ftc_jsb.campaign.run import Flown, Told, made, work_of
from ftc_jsb.campaign.sampling import unit_point
from ftc_jsb.campaign.search import Trace, minimise
from ftc_jsb.campaign.statistics import wilson
from ftc_jsb.campaign.store import SEARCH, SUBSET, Store, opened
from ftc_jsb.campaign.subset import subset_simulation
from ftc_jsb.errors import ScenarioError

Array = npt.NDArray[np.float64]
ALL = 2**62  # of the cases, into results.parquet


def _dimensions(bases: Bases) -> int:
    """Of the unit cube that is searched."""
    if bases.campaign.dimensions == 0:
        raise ScenarioError(
            "dispersion: missing; a search or a subset simulation needs one at least"
        )
    return bases.campaign.dimensions


@dataclass(frozen=True)
class Asked:
    """A campaign that can be asked for its objective at points of the unit cube."""

    store: Store
    engine: Engine
    known: dict[int, list[Row]]  # rows of cases that were flown
    objective: str
    told: Told
    total: int  # cases that are expected
    first: list[int]  # one number: of the next case

    def __call__(self, points: Array) -> list[float]:
        """The objective at (k, dimensions) points, the least of a case's flights; nan where none has it."""
        start = self.first[0]
        self.first[0] += len(points)
        items = [Item(start + k, tuple(map(float, point))) for k, point in enumerate(points)]
        missing = [item for item in items if item.number not in self.known]
        for batch in self.engine.batches(missing):
            self._take(batch)
        return [self._value(item.number) for item in items]

    def _take(self, batch: Batch) -> None:
        self.store.add(batch)
        for row in batch.rows:
            self.known.setdefault(row["case"], []).append(row)
        self.told(len(self.known), self.total, batch.seconds)

    def _value(self, number: int) -> float:
        values = [row.get(self.objective) for row in self.known[number]]
        numbers = [float(value) for value in values if isinstance(value, int | float)]
        return min(numbers, default=float("nan"))


def search_campaign(bases: Bases, folder: Path, client: Any, resume: bool, told: Told) -> Flown:
    """Look for the worst case with the first loop, and at random on the same budget; write `search.json`.

    Args:
        bases: the campaign; [search] says how.
        folder, client, resume, told: as for `run.fly_campaign`.

    Raises:
        UserError: the folder or a worker cannot be used.
    """
    settings = bases.campaign.search
    total = settings.flights * (2 if settings.baseline else 1)

    def work(ask: Asked, store: Store) -> None:
        blind: Trace | None = None
        dimensions = _dimensions(bases)
        if settings.baseline:
            plain = bases.campaign.model_copy(update={"sampling": "monte-carlo"})
            points = np.array([unit_point(plain, number) for number in range(settings.flights)])
            blind = Trace(points, np.array(ask(points)))
        found = minimise(ask, dimensions, settings.flights, bases.campaign.seed, settings.method)
        _write(store.folder / SEARCH, _comparison(bases, found, blind))

    return _adaptive(
        bases, folder, client, resume, ("search", settings.objective, total, told, work)
    )


def subset_campaign(bases: Bases, folder: Path, client: Any, resume: bool, told: Told) -> Flown:
    """Probability of a rare event, by [subset], with the first loop; write `subset.json`.

    Raises:
        UserError: the folder or a worker cannot be used.
    """
    settings = bases.campaign.subset
    if settings is None:
        raise ValueError("the campaign has no section [subset]")
    most = settings.samples * settings.levels

    def work(ask: Asked, store: Store) -> None:
        result = subset_simulation(
            lambda points: np.nan_to_num(np.array(ask(points)), nan=np.inf),
            _dimensions(bases),
            samples=settings.samples,
            level_probability=settings.level_probability,
            levels=settings.levels,
            threshold=settings.threshold,
            seed=bases.campaign.seed,
        )
        document = {
            "objective": settings.objective,
            "threshold": settings.threshold,
            "probability": result.probability,
            "coefficient_of_variation": result.coefficient_of_variation,
            "flights": result.evaluations,
            "levels": [level._asdict() for level in result.levels],
        }
        _write(store.folder / SUBSET, document)

    return _adaptive(
        bases, folder, client, resume, ("subset", settings.objective, most, told, work)
    )


def _adaptive(
    bases: Bases,
    folder: Path,
    client: Any,
    resume: bool,
    task: tuple[str, str, int, Told, Callable[[Asked, Store], None]],
) -> Flown:
    purpose, objective, total, told, work = task
    alone = bases._replace(
        campaign=bases.campaign.model_copy(update={"loops": bases.campaign.loops[:1]})
    )
    with opened(folder, bases, made(purpose), resume) as store:
        if store.complete:
            return Flown(store.cases(), 0, False)
        known: dict[int, list[Row]] = {}
        for row in store.rows():
            known.setdefault(row["case"], []).append(row)
        before = len(known)
        asked = Asked(store, Engine(client, work_of(alone)), known, objective, told, total, [0])
        work(asked, store)
        store.finish(ALL)
        return Flown(len(known), len(known) - before, False)


def _comparison(bases: Bases, found: Trace, blind: Trace | None) -> dict[str, Any]:
    settings = bases.campaign.search
    document: dict[str, Any] = {"method": settings.method, "objective": settings.objective}
    document |= _counts(found, "")
    if blind is not None:
        document |= _counts(blind, "random_")
    return document


def _counts(trace: Trace, prefix: str) -> dict[str, Any]:
    failures = int((trace.values < 0.0).sum())
    finite = trace.values[np.isfinite(trace.values)]
    return {
        f"{prefix}flights": trace.values.size,
        f"{prefix}failures": failures,
        f"{prefix}probability": wilson(failures, trace.values.size)._asdict(),
        f"{prefix}least": float(finite.min()) if finite.size else None,
        f"{prefix}first_failure": trace.first_below(0.0),
    }


def _write(path: Path, document: dict[str, Any]) -> None:
    with writing(path) as part:
        part.write_text(json.dumps(document, indent=2, allow_nan=False) + "\n", encoding="utf-8")
