"""What a campaign costs beside its flights: `python -m validation.campaign_cost [FACTOR]`, some minutes.

What is compared runs in turns in one process, so that a machine that others use slows down both sides: a case
against its flight alone, one worker against two. Scaling is given by the clock, which counts what others do
to two workers and not to one, and by the processor time of the workers, which counts it for neither.
"""

import statistics
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any, NamedTuple

from ftc_jsb.campaign.case import Bases, case_of, flights_of, scenario_of_case
from ftc_jsb.campaign.cluster import connected
from ftc_jsb.campaign.flights import Item, fly_items
from ftc_jsb.campaign.load import load_campaign
from ftc_jsb.campaign.run import fly_campaign, work_of
from ftc_jsb.simulation.fly import fly

HERE = Path(__file__).parent
CASES = {"point-mass": 2000, "jsbsim": 120}  # of two workers in a block; one has half as many
ROUNDS = 3
MEGA = 1e-6  # MB in a byte
KILO = 1e3  # bytes in what Linux counts memory by


class Block(NamedTuple):
    """Some cases flown by a cluster."""

    rate: float  # cases a second by the clock
    processor_rate: float  # cases a second of the workers' processor time
    flying: float  # part of the workers' time


def campaign(name: str, cases: int) -> Bases:
    """One of the campaigns beside this file, of `cases` cases."""
    bases = load_campaign(str(HERE / f"scale-{name}.toml"))
    return bases._replace(campaign=bases.campaign.model_copy(update={"cases": cases}))


def case_over_flight(name: str, count: int = 40) -> float:
    """Median of the time of a case, its row made, over that of the same flight by `fly` alone."""
    bases = campaign(name, count)
    work = work_of(bases, "none")
    ratios = []
    for number in range(count):
        scenario = scenario_of_case(case_of(bases, number), *flights_of(bases)[0])
        times = []
        for one in (lambda s=scenario: fly(s), lambda n=number: fly_items(work, [Item(n)])) * 2:
            started = time.perf_counter()
            one()
            times.append(time.perf_counter() - started)
        ratios.append(min(times[1], times[3]) / min(times[0], times[2]))
    return statistics.median(ratios[1:])  # the first loads the kernels


def block(bases: Bases, client: Any, workers: int) -> Block:
    """Fly a campaign into a folder that is thrown away."""
    spent: list[float] = []
    before = sum(client.run(time.process_time).values())
    with tempfile.TemporaryDirectory() as folder:
        started = time.perf_counter()
        flown = fly_campaign(
            bases, Path(folder), client, False, lambda _, __, seconds: spent.append(seconds)
        )
        elapsed = time.perf_counter() - started
    processor = sum(client.run(time.process_time).values()) - before
    return Block(flown.cases / elapsed, flown.cases / processor, sum(spent) / (workers * elapsed))


def peak_memory() -> float:
    """Most memory that this process had [MB]."""
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * KILO * 1.024 * MEGA


def report(factor: float) -> Iterator[str]:
    """Lines of the table; `factor` times as many cases as by default."""
    yield "| | point mass | JSBSim |"
    yield "|---|---|---|"
    names = list(CASES)
    cells = [f"{case_over_flight(name):.2f}" for name in names]
    yield f"| a case over its flight alone | {' | '.join(cells)} |"
    with ExitStack() as open_clusters:
        clients = {n: open_clusters.enter_context(connected(None, n)) for n in (1, 2)}
        found: dict[str, dict[int, list[Block]]] = {}
        for name in names:
            found[name] = {1: [], 2: []}
            for client in clients.values():
                block(campaign(name, 8), client, 1)  # loads the kernels
            for _ in range(ROUNDS):
                for workers, client in clients.items():
                    count = max(int(factor * CASES[name] * workers / 2), 8)
                    found[name][workers].append(block(campaign(name, count), client, workers))
        memory = max(mb for client in clients.values() for mb in client.run(peak_memory).values())
    for title, workers, field in (
        ("cases/s, one worker", 1, "rate"),
        ("cases/s, two workers", 2, "rate"),
        ("time that two workers fly, of all their time", 2, "flying"),
    ):
        cells = [f"{_median(found[name][workers], field):.3g}" for name in names]
        yield f"| {title} | {' | '.join(cells)} |"
    for title, field, parts in (
        ("1 → 2 workers by the clock", "rate", 1),
        ("1 → 2 workers by their processor time", "processor_rate", 2),
    ):
        cells = [
            f"{parts * _median(found[name][2], field) / _median(found[name][1], field):.2f}"
            for name in names
        ]
        yield f"| {title} | {' | '.join(cells)} |"
    yield f"| most memory of a worker [MB] | {memory:.0f} | |"


def _median(blocks: list[Block], field: str) -> float:
    return float(statistics.median(getattr(each, field) for each in blocks))


if __name__ == "__main__":
    for line in report(float(sys.argv[1]) if len(sys.argv) > 1 else 1.0):
        print(line, flush=True)
