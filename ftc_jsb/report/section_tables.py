"""Tables of the sections below the first screen: a row for each flight, or for each variable of a pair."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from markupsafe import Markup

from ftc_jsb.analysis.command_following import AXES
from ftc_jsb.analysis.filter_health import ACCELERATION, MEASURED
from ftc_jsb.analysis.residuals import Residuals
from ftc_jsb.analysis.validity import ERRORS, MOTION
from ftc_jsb.recording.flight import Flight
from ftc_jsb.report.display_names import flight_title
from ftc_jsb.report.flight_groups import by_scenario
from ftc_jsb.report.quoted_numbers import Path, Quote, quote

Flights = Mapping[str, Flight]
Document = dict[str, Any]
PERCENT = 100.0


class Table(NamedTuple):
    """Plain rows and columns."""

    title: str
    corner: str
    head: list[str]
    rows: list[tuple[str, list[Quote | Markup | str]]]


def difference_tables(flights: Flights, document: Document, titles: dict[str, str]) -> list[Table]:
    """One a pair: RMS, peak, Theil's coefficient and its three parts of each variable."""
    head = ["RMS", "peak", "Theil's U", "bias", "variance", "covariance"]
    tables = []
    for index, pair in enumerate(document["validity"]):
        rows: list[tuple[str, list[Quote | Markup | str]]] = []
        for variable in MOTION + ERRORS:
            place: Path = ("validity", index, "variables", variable.key)
            cells = [quote(document, (*place, key), 3) for key in ("rms", "peak", "theil")]
            cells += [
                quote(document, (*place, key), 0, PERCENT, rounded=True)
                for key in ("bias", "variance", "covariance")
            ]
            unit = f" [{variable.unit}]" if variable.unit else ""
            rows.append((variable.title + unit, list(cells)))
        place = ("validity", index, "variables", "position_m")
        apart = [quote(document, (*place, key), 1) for key in ("rms", "peak")]
        rows.append(("Position [m]", [*apart, "", "", "", ""]))
        title = f"{titles[pair['point_mass']]} minus JSBSim"
        tables.append(Table(title, "Difference", head, rows))
    return tables


def model_table(flights: Flights, document: Document, titles: dict[str, str]) -> Table:
    """Inner loop and models: how each command was answered, and what the models are wrong by."""
    head = []
    for axis in AXES:
        unit = f" [{axis.unit}]" if axis.unit else ""
        head += [f"{axis.title}, RMS{unit}", "delay [s]"]
    head += ["Drag of the law, RMS [kN]", "as effectiveness", "Drag of the estimator, RMS [kN]"]
    head += ["as effectiveness", "Thrust model, RMS [kN]"]
    rows: list[tuple[str, list[Quote | Markup | str]]] = []
    for label in flights:
        cells: list[Quote | Markup | str] = []
        for axis in AXES:
            place: Path = ("flights", label, "response", axis.key)
            cells += [
                quote(document, (*place, "rms"), 2),
                quote(document, (*place, "delay_s"), 2),
            ]
        for name in Residuals._fields:
            place = ("flights", label, "model_residuals", f"{name}_kn")
            cells.append(quote(document, (*place, "rms"), 3))
            if name != "thrust":
                cells.append(quote(document, (*place, "as_effectiveness_median"), 4))
        rows.append((titles[label], cells))
    return Table("", "Flight", head, rows)


def estimator_table(flights: Flights, document: Document, titles: dict[str, str]) -> Table:
    """Parts of the time inside the 95 % bounds, and what the filter could not see."""
    head = ["NIS inside", "Innovation inside: airspeed", "flight path", "heading", "acceleration"]
    names = (*MEASURED, ACCELERATION)
    head += ["Largest innovation [σ]", "Effectiveness inside ±2σ", "Thrust not observable"]
    rows: list[tuple[str, list[Quote | Markup | str]]] = []
    for label in flights:
        at = ("flights", label)
        keys = ["nis_inside_fraction", *(f"innovation_{name}_inside_fraction" for name in names)]
        cells: list[Quote | Markup | str] = [_percent(document, (*at, key)) for key in keys]
        peaks = [f"innovation_{name}_peak_sigmas" for name in names]
        largest = max(peaks, key=lambda key: document["flights"][label][key] or 0.0)
        cells.append(quote(document, (*at, largest), 1))
        cells.append(_percent(document, (*at, "effectiveness_thrust_inside_fraction")))
        cells.append(_percent(document, (*at, "unobservable_fraction", "thrust")))
        rows.append((titles[label], cells))
    return Table("", "Flight", head, rows)


def stability_table(flights: Flights, document: Document, titles: dict[str, str]) -> Table | None:
    """Of the flights that the theory is about; None without any."""
    rows: list[tuple[str, list[Quote | Markup | str]]] = []
    for label in flights:
        found = document["flights"][label]["stability"]
        if found is None:
            continue
        at = ("flights", label, "stability")
        keys = ("decay_rate_per_s", "disturbance", "ball_radius", "largest_error")
        cells: list[Quote | Markup | str] = [quote(document, (*at, key), 2) for key in keys]
        cells.append("yes" if found["bound_obeyed"] else "no")
        rows.append((titles[label], cells))
    head = ["λ [1/s]", "φ", "Radius of the ball", "Largest error", "V(t) below its bound"]
    return Table("", "Flight", head, rows) if rows else None


def flight_titles(flights: Flights) -> dict[str, str]:
    """Name of each flight on the page: model and loop, the scenario where there are several."""
    groups = by_scenario(flights)
    titles: dict[str, str] = {}
    for name, members in groups.items():
        for label, flight in members.items():
            title = flight_title(flight.scenario)
            titles[label] = f"{name}: {title}" if len(groups) > 1 else title
    names = list(titles.values())
    return {
        label: title if names.count(title) == 1 else f"{title} [{label}]"
        for label, title in titles.items()
    }


def _percent(document: Document, path: Path) -> Markup:
    number = quote(document, path, 1, PERCENT, rounded=True)
    return Markup("–") if number.value is None else Markup("{}\u202f%").format(number)
