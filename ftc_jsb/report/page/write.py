"""The report: one self-contained HTML file, its figures, and the numbers beside it."""

from collections.abc import Callable, Mapping, Sequence
from importlib import resources
from pathlib import Path
from types import MappingProxyType
from typing import Any

import jinja2
import markupsafe
import numpy as np

from ftc_jsb.atomic_file import write_text
from ftc_jsb.errors import RecordingError
from ftc_jsb.report.figures.draw import draw_all
from ftc_jsb.report.figures.style import FORMATS
from ftc_jsb.report.findings import analyse
from ftc_jsb.report.flight_groups import Flights
from ftc_jsb.report.measured_margins import MeasuredMargins
from ftc_jsb.report.page.chart_series import flight_series
from ftc_jsb.report.page.contents import page_contents
from ftc_jsb.report.page.linked_files import recording_links, write_scenarios
from ftc_jsb.runs.metrics_file import write_metrics


def _silent(_text: str) -> None:
    """Nobody asks how far the report is."""


def steps(flights: Flights) -> int:
    """How often `write_report` says what it begins."""
    return len(flights) + 3


@np.errstate(all="ignore")  # what overflows in a recording is null, and nothing to be seen
def write_report(
    flights: Flights,
    folder: Path,
    command: str,
    unread: tuple[str, ...] = (),
    margins: Sequence[MeasuredMargins] = (),
    tell: Callable[[str], None] = _silent,
    recordings: Mapping[str, Path] = MappingProxyType({}),
) -> dict[str, Any]:
    """Write `report.html`, `metrics.json`, the scenarios and `figures/` for flights by label.

    Args:
        flights: at least one.
        folder: exists and is writable.
        command: as typed, for the foot of the report.
        unread: what is wrong with recordings that could not be read.
        margins: of `ftc-jsb margins`, for the flights that they are of.
        tell: told what is begun, as often as `steps` says.
        recordings: files of the flights, by label, which the page links to.

    Returns:
        The contents of `metrics.json`.

    Raises:
        RecordingError: the folder cannot be written.
    """
    findings = analyse(flights, margins, tell)
    tell("charts")
    series = flight_series(flights, findings)
    findings.document["samples_per_point"] = {label: s.every for label, s in series.items()}
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("ftc_jsb.report.page", "templates"),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    try:
        write_metrics(folder / "metrics.json", findings.document)
        tell("figures")
        drawn = draw_all(flights, folder / "figures")
        tell("page")
        files = write_scenarios(flights, folder) + recording_links(flights, recordings, folder)
        contents = page_contents(flights, findings, series, unread)
        page = environment.get_template("report.html").render(
            **contents,
            command=command,
            files=files,
            figures=drawn,
            formats=FORMATS,
            script=_embedded(),
        )
        write_text(folder / "report.html", page)
    except OSError as error:
        raise RecordingError(f"{folder}: the report cannot be written: {error}") from None
    return findings.document


def _embedded() -> dict[str, markupsafe.Markup]:
    """The page's style, its script, and Plotly from its package: nothing is fetched."""
    from plotly.offline import get_plotlyjs

    here = resources.files("ftc_jsb.report.page") / "templates"
    parts = sorted((here / "script").iterdir(), key=lambda part: part.name)
    page = "".join(part.read_text(encoding="utf-8") for part in parts if part.name.endswith(".js"))
    return {
        "style": markupsafe.Markup((here / "report.css").read_text(encoding="utf-8")),
        "plotly": markupsafe.Markup(get_plotlyjs()),
        "page": markupsafe.Markup(f'"use strict";\n(() => {{\n{page}}})();'),
    }
