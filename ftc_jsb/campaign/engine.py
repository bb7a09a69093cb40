"""Cases shared out among the workers of a cluster, in batches, and taken back as they are done."""

import math
from collections.abc import Iterator, Sequence
from typing import Any

from ftc_jsb.campaign.case import Bases, flights_of
from ftc_jsb.campaign.flights import Batch, Item, Work, drawn_case, fly_items, identity
from ftc_jsb.campaign.load import unpacked

TARGET = 4.0  # [s] of work in a batch: scheduling takes some 10 ms of it
AHEAD = 2  # batches a worker that wait or fly
LARGEST = 2000  # cases in a batch


class Engine:
    """Flies items on a cluster; whatever worker, order and number of workers, the rows are the same."""

    def __init__(self, client: Any, work: Work) -> None:
        """Args: `distributed.Client`; the campaign."""
        self._client = client
        self._work = work
        self._bases: Bases = unpacked(work.campaign)
        self._pace: float | None = None  # [s] a case, of the batches so far
        self._suspects: list[Item] = []  # with each of them a process died that flew others, too

    @property
    def workers(self) -> int:
        """Workers that are there now."""
        return max(len(self._client.scheduler_info(n_workers=-1)["workers"]), 1)

    def batches(self, items: Sequence[Item]) -> Iterator[Batch]:
        """Batches in the order in which they are done; closing the iterator cancels the rest."""
        from distributed import as_completed

        waiting = list(reversed(items))
        flying: dict[Any, list[Item]] = {}
        done = as_completed()
        try:
            while waiting or flying or self._suspects:
                while waiting and len(flying) < AHEAD * self.workers:
                    self._submit(self._next(waiting), flying, done)
                alone = not flying
                if alone:
                    self._submit([self._suspects.pop()], flying, done)
                future = next(done)
                batch = self._taken(future, flying, waiting, alone)
                if batch is not None:
                    yield batch
        finally:
            for future in flying:
                future.cancel()

    def _next(self, waiting: list[Item]) -> list[Item]:
        """The next batch: some seconds of work, and at the end no more than its share of what is left."""
        size = 1 if self._pace is None else max(1, min(int(TARGET / self._pace), LARGEST))
        size = min(size, math.ceil(len(waiting) / (AHEAD * self.workers)))
        return [waiting.pop() for _ in range(size)]

    def _submit(self, items: list[Item], flying: dict[Any, list[Item]], done: Any) -> None:
        future = self._client.submit(fly_items, self._work, items, pure=False)
        flying[future] = items
        done.add(future)

    def _taken(
        self, future: Any, flying: dict[Any, list[Item]], waiting: list[Item], alone: bool
    ) -> Batch | None:
        """The batch of a future, or None where its worker died.

        Dask holds a death against every batch that the worker had, waiting ones too. So its cases are flown
        one by one, and those whose worker dies again alone at the end: who dies alone is not a neighbour.
        """
        from distributed import KilledWorker

        items = flying.pop(future)
        try:
            batch: Batch = future.result()
        except KilledWorker:
            if alone:
                return self._fatal(items[0])
            if len(items) == 1:
                self._suspects.append(items[0])
            else:
                waiting.extend(reversed(items))
                self._pace = math.inf  # one case a batch from here on, until one is done
            return None
        pace = batch.seconds / len(items)
        known = self._pace is not None and math.isfinite(self._pace)
        self._pace = 0.5 * ((self._pace or 0.0) + pace) if known else pace
        return batch

    def _fatal(self, item: Item) -> Batch:
        """Rows of a case that ends whatever process flies it."""
        case, _ = drawn_case(self._bases, item)
        reason = {"verdict": None, "error": "the process that flew it died"}
        pairs = flights_of(self._bases)
        return Batch([identity(case, *pair) | reason for pair in pairs], {}, 0.0)
