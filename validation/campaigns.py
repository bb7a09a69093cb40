"""The shipped campaign `robustness`: where fault tolerance ends, and for want of what.

`python -m validation.campaigns RESULTS.parquet` prints the table of a campaign that was flown.
"""

import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import pandas as pd

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.analysis.verdict import INSIDE
from ftc_jsb.campaign.case import Bases, case_of, scenario_of_case
from ftc_jsb.campaign.flights import Item, Row, fly_items
from ftc_jsb.campaign.load import load_campaign
from ftc_jsb.campaign.run import work_of
from ftc_jsb.campaign.statistics import wilson
from ftc_jsb.errors import UserError
from ftc_jsb.simulation.fly import fly
from validation.thrust_need import thrust_need

CASES = 512  # a power of 2, as the Sobol sequence is balanced by
PROCESSES = 2
LOOPS = ("ftc", "no-ftc", "robust")
JUDGED = "robust"  # its failures are traced to what they come from
FAULT = "parameter.fault"
CAUSES = ("twin", "no loop", "short", "enough")
HEADS = (
    "fault", "cases", "outside limits: ftc", "no-ftc", "robust", "of robust's: healthy twin, too",
    "thrust for no loop", "thrust short", "thrust enough",
)  # fmt: skip


def robustness_section(cases: int = CASES) -> Iterator[str]:
    """Lines of the section."""
    bases = load_campaign("robustness")
    fly_some = partial(fly_items, work_of(bases))
    with ProcessPoolExecutor(PROCESSES) as pool:
        parts = list(pool.map(fly_some, _parts([Item(number) for number in range(cases)])))
    yield from robustness_table(bases, pd.DataFrame([row for part in parts for row in part.rows]))


def _parts(items: list[Item], size: int = 16) -> list[list[Item]]:
    return [items[k : k + size] for k in range(0, len(items), size)]


def robustness_table(bases: Bases, results: pd.DataFrame) -> Iterator[str]:
    """A row for each fault class; failures of the loop JUDGED by what they come from.

    Args:
        bases: the campaign.
        results: rows of its first cases.
    """
    flown = results[results["verdict"].notna()]
    failed = flown[(flown["loop"] == JUDGED) & (flown["verdict"] != INSIDE)]
    with ProcessPoolExecutor(PROCESSES) as pool:
        found = pool.map(partial(cause, bases), failed["case"].astype(int), failed[FAULT])
        causes = dict(zip(failed["case"].astype(int), found, strict=True))
    yield "| " + " | ".join(HEADS) + " |"
    yield "|---" * len(HEADS) + "|"
    groups: list[tuple[str, Any]] = [*flown.groupby(FAULT), ("all", flown)]
    for fault, group in groups:
        here = set(group["case"].astype(int)) & set(causes)
        cells = [fault, str(group["case"].nunique())]
        cells += [_outside(group[group["loop"] == loop]["verdict"]) for loop in LOOPS]
        cells += [str(sum(causes[number] == name for number in here)) for name in CAUSES]
        yield "| " + " | ".join(cells) + " |"
    yield ""
    lost = flown[flown["verdict"].isin(["loss of control", "departed"])]
    counts = ", ".join(f"{loop} {count}" for loop, count in lost["loop"].value_counts().items())
    yield f"Control was lost with: {counts or 'none'}."
    for name in ("short", "enough"):
        numbers = sorted(number for number, why in causes.items() if why == name)
        yield f"Thrust {name}: cases {', '.join(map(str, numbers)) or '–'}."


def _outside(verdicts: "pd.Series[Any]") -> str:
    found = wilson(int((verdicts != INSIDE).sum()), len(verdicts))
    return f"{100 * found.value:.0f} % ({100 * found.low:.0f}–{100 * found.high:.0f})"


def cause(bases: Bases, number: int, fault: str) -> str:
    """One of CAUSES for a case that failed with the loop JUDGED.

    Args:
        bases: the campaign.
        number: of the case.
        fault: its class; "none" is its own twin.
    """
    if fault == "none":
        return "twin"
    case = case_of(bases, number)
    healthy = case._replace(values=case.values | {"fault": []})
    try:
        twin = fly(scenario_of_case(healthy, "jsbsim", JUDGED))
    except UserError:
        return "twin"
    if flight_metrics(twin)["verdict"] != INSIDE:
        return "twin"
    flown = fly(scenario_of_case(case, "jsbsim", JUDGED))
    metrics: Row = flight_metrics(flown)
    times = [limit["time"] for limit in metrics["limits_broken"]]
    return thrust_need(flown, twin, min(times, default=metrics["end_time_s"])).cause


if __name__ == "__main__":
    place = Path(sys.argv[1])
    campaign = load_campaign(str(place.with_name("campaign.toml")))
    print("\n".join(robustness_table(campaign, pd.read_parquet(place))))
