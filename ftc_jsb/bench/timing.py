"""Timing on a machine that others use, too: what is compared is measured in turns."""

import statistics
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import TypeVar

Job = TypeVar("Job")


def in_turns(works: Mapping[str, Callable[[], int]], rounds: int) -> dict[str, list[float]]:
    """Seconds a unit of each work, round by round, the works in turn.

    Args:
        works: by name; each is called once a round and returns how many units it did.
        rounds: how often; one more goes before, which is not counted.
    """
    times: dict[str, list[float]] = {name: [] for name in works}
    for turn in range(rounds + 1):
        for name, work in works.items():
            started = time.perf_counter()
            units = work()
            elapsed = time.perf_counter() - started
            if turn:
                times[name].append(elapsed / units)
    return times


def ratio(above: list[float], below: list[float]) -> float:
    """Median of the ratios of rounds."""
    return statistics.median(a / b for a, b in zip(above, below, strict=True))


def in_two_processes(
    work: Callable[[Job], object], warm_up: Sequence[Job], jobs: Sequence[Job]
) -> float:
    """Wall time [s] of `jobs` in two processes, once both have started and loaded.

    Args:
        work: a function of a module, called once for each job.
        warm_up: jobs that go before, enough for both processes to get one.
        jobs: what is timed.
    """
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        list(pool.map(work, warm_up))
        started = time.perf_counter()
        list(pool.map(work, jobs))
        return time.perf_counter() - started
