"""The shipped campaign `robustness` at a modest size: where fault tolerance ends, and for want of what.

`python -m validation.campaigns RESULTS.parquet` prints the table of a campaign that was flown.
"""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pandas as pd

from ftc_jsb.analysis.verdict import INSIDE
from ftc_jsb.campaign.case import Bases, case_of, scenario_of_case
from ftc_jsb.campaign.flights import Item, fly_items, row_of
from ftc_jsb.campaign.load import load_campaign
from ftc_jsb.campaign.run import work_of
from ftc_jsb.campaign.statistics import wilson
from ftc_jsb.errors import UserError
from ftc_jsb.simulation.fly import fly

CASES = 128  # a power of 2, as the Sobol sequence is balanced by
GIVEN_UP = 0.1  # [deg] of path or [deg/s] of turn: less is not for want of thrust
FAULT = "parameter.fault"
HEADS = (
    "fault", "flights", "outside limits: ftc", "no-ftc", "healthy twin fails, too", "for want of thrust",
    "neither",
)  # fmt: skip


def robustness_section(cases: int = CASES) -> Iterator[str]:
    """Lines of the section: flown here, in this process."""
    bases = load_campaign("robustness")
    rows = fly_items(work_of(bases), [Item(number) for number in range(cases)]).rows
    yield from robustness_table(bases, pd.DataFrame(rows))


def robustness_table(bases: Bases, results: pd.DataFrame) -> Iterator[str]:
    """A row for each fault class; failures of `ftc` by what they are for want of.

    A healthy twin is the same case without its fault. What fails with it is not the fault's doing; of the
    rest, what gave up path or turn was short of thrust.

    Args:
        bases: the campaign.
        results: rows of its first cases.
    """
    flown = results[results["verdict"].notna()]
    failed = flown[(flown["loop"] == "ftc") & (flown["verdict"] != INSIDE)]
    causes = {int(row["case"]): _cause(bases, row) for _, row in failed.iterrows()}
    yield "| " + " | ".join(HEADS) + " |"
    yield "|---" * len(HEADS) + "|"
    groups: list[tuple[str, Any]] = [*flown.groupby(FAULT), ("all", flown)]
    for fault, group in groups:
        cells = [fault, str(group["case"].nunique())]
        for loop in ("ftc", "no-ftc"):
            verdicts = group[group["loop"] == loop]["verdict"]
            found = wilson(int((verdicts != INSIDE).sum()), len(verdicts))
            cells.append(
                f"{100 * found.value:.0f} % ({100 * found.low:.0f}–{100 * found.high:.0f})"
            )
        here = [causes[number] for number in set(group["case"]) & set(causes)]
        cells += [str(here.count(cause)) for cause in ("twin", "thrust", "neither")]
        yield "| " + " | ".join(cells) + " |"
    left = [number for number, cause in causes.items() if cause == "neither"]
    lost = flown[flown["verdict"].isin(["loss of control", "departed"])]
    counts = ", ".join(f"{loop} {count}" for loop, count in lost["loop"].value_counts().items())
    yield ""
    cases = ", ".join(map(str, sorted(left))) or "–"
    yield f"Control was lost in: {counts or 'no flight'}. Neither: cases {cases}."


def _cause(bases: Bases, row: "pd.Series[Any]") -> str:
    case = case_of(bases, int(row["case"]))
    if row[FAULT] == "none":
        return "twin"
    twin = case._replace(values=case.values | {"fault": []})
    try:
        metrics = row_of(fly(scenario_of_case(twin, "jsbsim", "ftc")))
    except UserError:
        return "twin"
    if metrics["verdict"] != INSIDE:
        return "twin"
    given_up = max(row["peak_climb_given_up_deg"] or 0.0, row["peak_turn_given_up_deg_s"] or 0.0)
    return "thrust" if given_up > GIVEN_UP else "neither"


if __name__ == "__main__":
    place = Path(sys.argv[1])
    campaign = load_campaign(str(place.with_name("campaign.toml")))
    print("\n".join(robustness_table(campaign, pd.read_parquet(place))))
