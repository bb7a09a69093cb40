"""report.html of a campaign: one self-contained page in the style of the comparison report."""

from importlib import resources
from typing import Any

import jinja2
import markupsafe
import numpy as np
import pandas as pd

from ftc_jsb.analysis.verdict import INSIDE
from ftc_jsb.campaign.page.drawings import Axes, curves, failures, span
from ftc_jsb.campaign.schema import Campaign
from ftc_jsb.campaign.summary import PARAMETER
from ftc_jsb.report.titles import limit_title

Document = dict[str, Any]
DIFFERENCES = {  # of `summary.summary`, as they are shown
    "margin": "Margin",
    "rmse_airspeed_mps": "Airspeed RMSE [m/s]",
    "rmse_flight_path_deg": "Path RMSE [deg]",
    "rmse_heading_deg": "Heading RMSE [deg]",
}
_MAPS = 4  # labels whose failures are drawn


def page(campaign: Campaign, document: Document, table: pd.DataFrame, made: list[str]) -> str:
    """The page as HTML.

    Args:
        campaign: that was flown.
        document: of `summary.summary`.
        table: of `summary.read_table`.
        made: lines on what it was flown with.
    """
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("ftc_jsb.campaign.page", "templates"),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    environment.filters["percent"] = percent
    environment.filters["interval"] = interval
    environment.filters["number"] = number
    environment.filters["limit"] = limit_title
    style = resources.files("ftc_jsb.report.page") / "templates" / "report.css"
    return environment.get_template("campaign.html").render(
        campaign=campaign,
        document=document,
        differences=DIFFERENCES,
        margins=_margins(table),
        maps=_maps(document, table),
        roc=_roc(document),
        made=made,
        style=markupsafe.Markup(style.read_text(encoding="utf-8")),
    )


def percent(entry: Document) -> str:
    """A probability in percent with its interval."""
    if entry["value"] is None:
        return "–"
    value, low, high = (100.0 * entry[key] for key in ("value", "low", "high"))
    return f"{value:.3g} % ({low:.2g} to {high:.2g})"


def interval(entry: Document) -> str:
    """A number with its interval."""
    shown = [number(entry[key]) for key in ("value", "low", "high")]
    return f"{shown[0]} ({shown[1]} to {shown[2]})"


def number(value: Any) -> str:
    """A number to three digits; a text as it is."""
    if value is None:
        return "–"
    return f"{value:.3g}" if isinstance(value, int | float) else str(value)


def _margins(table: pd.DataFrame) -> markupsafe.Markup | None:
    """Distribution of the margin for each model and loop."""
    lines = []
    for label, group in table.groupby("label", sort=False):
        values = np.sort(group["margin"].dropna().to_numpy(float))
        if values.size:
            at = np.unique(np.linspace(0, values.size - 1, min(values.size, 300)).astype(int))
            lines.append((str(label), values[at], (at + 1.0) / values.size))
    if not lines:
        return None
    ends = span(np.concatenate([xs for _, xs, _ in lines]))
    return curves(
        Axes(ends, (0.0, 1.0), "Robustness margin", "Part of the flights below"), lines, (0.0,)
    )


def _maps(document: Document, table: pd.DataFrame) -> list[tuple[str, markupsafe.Markup]]:
    """Failures over the two numeric parameters that explain most, of each model and loop that has any."""
    found: list[tuple[str, markupsafe.Markup]] = []
    for label, ranked in document["importance"].items():
        group = table[(table["label"] == label) & table["verdict"].notna()]
        numeric = [
            entry["parameter"]
            for entry in ranked
            if pd.api.types.is_numeric_dtype(group[PARAMETER + entry["parameter"]])
        ]
        failed = (group["verdict"] != INSIDE).to_numpy()
        if len(numeric) < 2 or not failed.any() or len(found) == _MAPS:
            continue
        x, y = (group[PARAMETER + name].to_numpy(float) for name in numeric[:2])
        axes = Axes(span(x), span(y), numeric[0], numeric[1])
        found.append((label, failures(axes, x, y, failed)))
    return found


def _roc(document: Document) -> markupsafe.Markup | None:
    lines = []
    for label, flight in document["flights"].items():
        if flight["detection"] is not None:
            curve = flight["detection"]["curve"]
            xs, ys = (np.array([p[k] for p in curve]) for k in ("false_alarm", "detection"))
            area = flight["detection"]["area"]["value"]
            lines.append((f"{label}, area {area:.3f}", np.append(1.0, xs), np.append(1.0, ys)))
    if not lines:
        return None
    axes = Axes(
        (0.0, 1.0), (0.0, 1.0), "Healthy flights above a threshold", "Faulty flights above it"
    )
    return curves(axes, lines, chance=True)
