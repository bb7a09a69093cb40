"""A campaign flown into a folder, from its beginning or from where it was left."""

from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from ftc_jsb.campaign.case import Bases
from ftc_jsb.campaign.engine import Engine
from ftc_jsb.campaign.flights import Batch, Item, Work, fly_items
from ftc_jsb.campaign.load import load_campaign, packed
from ftc_jsb.campaign.parquet import read_rows
from ftc_jsb.campaign.provenance import code_digest
from ftc_jsb.campaign.schema import Campaign
from ftc_jsb.campaign.stopping import COLUMNS, Looks
from ftc_jsb.campaign.store import RESULTS, Store, opened
from ftc_jsb.errors import RecordingError
from ftc_jsb.recording.provenance import machine, versions

Told = Callable[
    [int, int, float], None
]  # cases done, cases in all, seconds that flying the last took


class Flown(NamedTuple):
    """How far a campaign came."""

    cases: int
    flown_now: int
    stopped: bool  # by its rule, before all its cases


def made(purpose: str = "sampling") -> dict[str, Any]:
    """With what a campaign is flown, and what for."""
    return {"purpose": purpose, "code": code_digest(), "versions": versions(), "machine": machine()}


def work_of(bases: Bases, keep: str | None = None) -> Work:
    """A campaign as workers take it."""
    policy = keep or bases.campaign.recordings
    return Work(packed(bases), code_digest(), "none" if policy == "worst" else policy)


def fly_campaign(bases: Bases, folder: Path, client: Any, resume: bool, told: Told) -> Flown:
    """Fly what is missing, write `results.parquet`.

    Args:
        bases: the campaign.
        folder: exists.
        client: `distributed.Client`.
        resume: go on with what is there.
        told: called after every batch.

    Raises:
        UserError: the folder or a worker cannot be used.
    """
    campaign = bases.campaign
    with opened(folder, bases, made(), resume) as store:
        if store.complete:
            _keep_worst(bases, store, client)
            return Flown(store.cases(), 0, False)
        looks = Looks(campaign.stop)
        looks.add(store.rows(COLUMNS))
        finished = store.finished()
        missing = [Item(number) for number in range(campaign.count) if number not in finished]
        flown, end = 0, looks.end
        if missing and end is None:
            engine = Engine(client, work_of(bases))
            for batch in engine.batches(missing):
                store.add(batch)
                looks.add(batch.rows)
                cases = len({row["case"] for row in batch.rows})
                flown += cases
                told(len(finished) + flown, campaign.count, batch.seconds)
                end = looks.end
                if end is not None:
                    break
        store.finish(campaign.count if end is None else end)
        _keep_worst(bases, store, client)
    return Flown(campaign.count if end is None else end, flown, end is not None)


def _keep_worst(bases: Bases, store: Store, client: Any) -> None:
    """If recordings of the worst cases are asked for, fly those again, the same to the bit, and keep them."""
    if bases.campaign.recordings != "worst":
        return
    worst = worst_cases(store.folder, bases.campaign)
    items = [Item(number) for number in worst if not store.kept(number)]
    for batch in Engine(client, work_of(bases, "all")).batches(items):
        for (number, label), contents in batch.recordings.items():
            store.keep(number, label, contents)


def worst_cases(folder: Path, campaign: Campaign) -> list[int]:
    """Numbers of the cases with the least margin of any of their flights, the worst first."""
    least: dict[int, float] = {}
    for row in read_rows(folder / RESULTS, ["case", "margin"]):
        if row.get("margin") is not None:
            least[row["case"]] = min(least.get(row["case"], row["margin"]), row["margin"])
    return sorted(least, key=lambda number: (least[number], number))[: campaign.worst]


def rerun(folder: Path, number: int) -> tuple[list[dict[str, Any]], list[str], dict[str, bytes]]:
    """One case again.

    Args:
        folder: of a campaign.
        number: of the case.

    Returns:
        Its rows, the columns that are not as they were, and its recordings by label.

    Raises:
        UserError: no such campaign or case.
    """
    bases = load_campaign(str(folder / "campaign.toml"))
    before = [row for row in _known_rows(folder) if row["case"] == number]
    if not before and number >= bases.campaign.count:
        raise RecordingError(
            f"{folder}: has no case {number}; expected 0 to {bases.campaign.count - 1}"
        )
    point = before[0].get("point") if before else None
    batch: Batch = fly_items(work_of(bases, "all"), [Item(number, point and tuple(point))])
    recordings = {label: contents for (_, label), contents in batch.recordings.items()}
    return batch.rows, differing(before, batch.rows), recordings


def differing(before: Iterable[dict[str, Any]], now: Iterable[dict[str, Any]]) -> list[str]:
    """Columns in which two flights of a case differ."""
    found: dict[str, None] = {}
    for old, new in zip(before, now, strict=False):
        for name in old:
            same = old[name] == new.get(name) or (
                old[name] != old[name] and new.get(name) != new.get(name)
            )
            if not same:
                found[name] = None
    return list(found)


def _known_rows(folder: Path) -> list[dict[str, Any]]:
    if (folder / RESULTS).is_file():
        return read_rows(folder / RESULTS)
    return Store(folder).rows()


def seconds_a_case(bases: Bases) -> float:
    """Time that a case takes here, kernels compiled: the first one, flown twice."""
    fly = partial(fly_items, work_of(bases, "none"), [Item(0)])
    fly()
    return fly().seconds
