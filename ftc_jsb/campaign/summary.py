"""The numbers of a campaign: how often what happens, for whom, where, and which cases are the worst."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from ftc_jsb.analysis.ftc_effect import PAIRS
from ftc_jsb.analysis.verdict import INSIDE, VERDICTS
from ftc_jsb.campaign.schema import EVENTS, Campaign
from ftc_jsb.campaign.sensitivity import first_order, grouped
from ftc_jsb.campaign.statistics import (
    Interval,
    area_under_roc,
    mean_difference,
    paired_probability,
    rate,
    wilson,
)
from ftc_jsb.campaign.stopping import SECONDS, events_of

Document = dict[str, Any]
QUANTILES = (0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99)
PARAMETER = "parameter."
SHOWN_PARAMETERS = 3  # whose bins are listed


def read_table(path: Path) -> pd.DataFrame:
    """`results.parquet` as a table, the flights' labels in `label`."""
    table = pd.read_parquet(path)
    table["label"] = table["model"].astype(str) + "-" + table["loop"].astype(str)
    return table


def summary(campaign: Campaign, table: pd.DataFrame) -> Document:
    """The contents of `summary.json`.

    Args:
        campaign: that was flown.
        table: of `read_table`.
    """
    groups = {str(label): group for label, group in table.groupby("label", sort=False)}
    return {
        "campaign": campaign.name,
        "cases": int(table["case"].nunique()),
        "flights": {label: flight_summary(campaign, group) for label, group in groups.items()},
        "pairs": pairs(groups),
        "importance": {label: importance(group) for label, group in groups.items()},
        "not_flown": _not_flown(table),
        "worst": worst(campaign, table),
    }


def flight_summary(campaign: Campaign, group: pd.DataFrame) -> Document:
    """Probabilities, rates and margins of the flights of one model and loop."""
    confidence = campaign.stop.confidence if campaign.stop is not None else 0.95
    flown = group[group["verdict"].notna()]
    cases = len(flown)
    hours = float(flown["end_time_s"].sum()) / SECONDS if cases else 0.0
    broken = flown["limits_broken"].fillna("").str.split() if cases else pd.Series(dtype=object)
    limits = sorted({name for names in broken for name in names})
    return {
        "flown": cases,
        "not_flown": len(group) - cases,
        "hours": hours,
        "verdicts": {
            verdict: _probability(int((flown["verdict"] == verdict).sum()), cases, confidence)
            for verdict in VERDICTS
        },
        "limits": {
            name: _probability(sum(name in names for names in broken), cases, confidence)
            for name in limits
        },
        "events": _events(flown, hours, confidence),
        "margin": _quantiles(flown, "margin"),
        "margin_estimate": _quantiles(flown, "margin_estimate"),
        "detection": detection(flown) if campaign.roc else None,
    }


def detection(flown: pd.DataFrame) -> Document | None:
    """ROC of the detector's statistic: flights before a fault against flights with one."""
    if not {"statistic_peak_healthy", "statistic_peak_faulty"} <= set(flown.columns):
        return None
    healthy = flown["statistic_peak_healthy"].dropna().to_numpy(float)
    faulty = flown["statistic_peak_faulty"].dropna().to_numpy(float)
    if not healthy.size or not faulty.size:
        return None
    thresholds = np.unique(np.quantile(np.concatenate([healthy, faulty]), np.linspace(0, 1, 101)))
    curve = [
        {
            "threshold": float(at),
            "false_alarm": float((healthy > at).mean()),
            "detection": float((faulty > at).mean()),
        }
        for at in thresholds
    ]
    return {"area": area_under_roc(healthy, faulty)._asdict(), "curve": curve}


def pairs(groups: dict[str, pd.DataFrame]) -> list[Document]:
    """Loops of one model on the same cases: the first against each other one, and FTC against none."""
    found = []
    labels = list(groups)
    for index, first in enumerate(labels):
        for second in labels[index + 1 :]:
            one, two = groups[first], groups[second]
            if one["model"].iloc[0] == two["model"].iloc[0]:
                with_ftc = PAIRS.get(two["loop"].iloc[0]) == one["loop"].iloc[0]
                names = (second, first) if with_ftc else (first, second)
                found.append(_pair(*names, groups))
    return found


def importance(group: pd.DataFrame) -> list[Document]:
    """Ranking of the parameters by what they explain of the margin; bins of the first of them."""
    flown = group[group["verdict"].notna()]
    columns = [
        name for name in flown.columns if name.startswith(PARAMETER) and not name.endswith(".seed")
    ]
    if len(flown) < 20 or not columns:
        return []
    ranked = first_order(flown[columns], flown["margin"].to_numpy(float))
    found = []
    for place, index in enumerate(ranked):
        entry: Document = {**index._asdict(), "parameter": index.parameter.removeprefix(PARAMETER)}
        if place < SHOWN_PARAMETERS:
            entry["failures"] = _bins(flown, index.parameter)
        found.append(entry)
    return found


def worst(campaign: Campaign, table: pd.DataFrame) -> list[Document]:
    """Flights of the least margins, one a case, the worst first."""
    known = table[table["margin"].notna()].sort_values(["margin", "case"], kind="stable")
    first = known.drop_duplicates("case").head(campaign.worst)
    keys = ["case", "model", "loop", "verdict", "margin", "margin_limit", "margin_time_s"]
    return [
        {key: _plain(row[key]) for key in keys}
        | {
            "parameters": {
                name.removeprefix(PARAMETER): _plain(row[name])
                for name in table.columns
                if name.startswith(PARAMETER) and not pd.isna(row[name])
            }
        }
        for _, row in first.iterrows()
    ]


def _events(flown: pd.DataFrame, hours: float, confidence: float) -> Document:
    rows = flown.to_dict("records")
    for row in rows:
        for key in ("false_alarms", "detection_delay_s"):
            row[key] = None if pd.isna(row.get(key)) else row[key]
    found: Document = {}
    for event in EVENTS:
        counts = [count for row in rows if (count := events_of(event, row)) is not None]
        if not counts:
            continue
        total = sum(counts)
        found[event] = {
            **_probability(sum(map(bool, counts)), len(counts), confidence),
            "events": total,
            "per_hour": rate(total, hours, confidence)._asdict(),
        }
    return found


def _pair(first: str, second: str, groups: dict[str, pd.DataFrame]) -> Document:
    both = groups[first].merge(groups[second], on="case", suffixes=("", "_2"))
    both = both[both["verdict"].notna() & both["verdict_2"].notna()]
    one, two = both["verdict"] != INSIDE, both["verdict_2"] != INSIDE
    only = int((one & ~two).sum()), int((two & ~one).sum())
    differences = {
        name: _interval(mean_difference((both[name] - both[f"{name}_2"]).to_numpy(float)))
        for name in ("margin", "rmse_airspeed_mps", "rmse_flight_path_deg", "rmse_heading_deg")
        if name in both
    }
    return {
        "first": first,
        "second": second,
        "cases": len(both),
        "only_first_fails": only[0],
        "only_second_fails": only[1],
        "failure": _interval(paired_probability(*only, len(both))),
        "mean_difference": differences,
    }


def _bins(flown: pd.DataFrame, name: str) -> list[Document]:
    """Probability of failure over the bins of a parameter."""
    codes = grouped(flown[name])
    failed = (flown["verdict"] != INSIDE).to_numpy()
    found = []
    for code in np.unique(codes):
        inside = codes == code
        values = flown[name][inside]
        numeric = pd.api.types.is_numeric_dtype(values) and values.notna().any()
        low, high = (_plain(values.min()), _plain(values.max())) if numeric else (None, None)
        label = f"{low:.4g} – {high:.4g}" if numeric else str(_plain(values.iloc[0]) or "–")
        entry = {"label": label, "low": low, "high": high}
        found.append(entry | _probability(int(failed[inside].sum()), int(inside.sum()), 0.95))
    return found


def _not_flown(table: pd.DataFrame) -> list[Document]:
    errors = table[table["error"].notna()] if "error" in table else table.iloc[:0]
    counts = errors.groupby("error", sort=False)["case"].agg(["count", "first"])
    return [
        {"reason": str(reason), "flights": int(row["count"]), "first_case": int(row["first"])}
        for reason, row in counts.sort_values("count", ascending=False).head(20).iterrows()
    ]


def _probability(events: int, cases: int, confidence: float) -> Document:
    return {"count": events, "of": cases, **_interval(wilson(events, cases, confidence))}


def _interval(interval: Interval) -> Document:
    return {
        name: value if np.isfinite(value) else None for name, value in interval._asdict().items()
    }


def _quantiles(flown: pd.DataFrame, name: str) -> Document | None:
    values = flown[name].dropna().to_numpy(float) if name in flown else np.zeros(0)
    if not values.size:
        return None
    found = np.quantile(values, QUANTILES)
    return {f"q{100 * at:02.0f}": float(value) for at, value in zip(QUANTILES, found, strict=True)}


def _plain(value: Any) -> Any:
    """A number or a text as JSON has it."""
    if value is None or (isinstance(value, float) and not np.isfinite(value)):
        return None
    return value.item() if isinstance(value, np.generic) else value
