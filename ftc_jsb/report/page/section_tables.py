"""Tables of the sections below the first screen: a row for each flight, or for each variable of a pair."""

from typing import Any, NamedTuple

from markupsafe import Markup

from ftc_jsb.analysis.command_following import AXES
from ftc_jsb.analysis.filter_health import INNOVATIONS
from ftc_jsb.analysis.model_residuals import Residuals
from ftc_jsb.analysis.validity import ERRORS, MOTION
from ftc_jsb.report.flight_groups import Flights
from ftc_jsb.report.page.linked_numbers import LinkedNumber, Path, linked_number
from ftc_jsb.vocabulary.quantities import QUANTITIES, with_unit

Document = dict[str, Any]
PERCENT = 100.0
Cell = LinkedNumber | Markup | str


class PlainTable(NamedTuple):
    """Rows and columns of a section."""

    title: str
    corner: str
    head: list[str]
    rows: list[tuple[str, list[Cell]]]


def difference_tables(
    flights: Flights, document: Document, titles: dict[str, str]
) -> list[PlainTable]:
    """One a pair: RMS, peak, Theil's coefficient and its three parts of each variable."""
    head = ["RMS", "peak", "Theil's U", "bias", "variance", "covariance"]
    tables = []
    for index, pair in enumerate(document["validity"]):
        rows: list[tuple[str, list[Cell]]] = []
        for variable in MOTION + ERRORS:
            place: Path = ("validity", index, "variables", variable.key)
            cells = [linked_number(document, (*place, key), 3) for key in ("rms", "peak", "theil")]
            cells += [
                linked_number(document, (*place, key), 0, PERCENT, rounded=True)
                for key in ("bias", "variance", "covariance")
            ]
            rows.append((variable.heading, list(cells)))
        place = ("validity", index, "variables", "position_m")
        apart = [linked_number(document, (*place, key), 1) for key in ("rms", "peak")]
        rows.append((QUANTITIES["position"].heading, [*apart, "", "", "", ""]))
        title = f"{titles[pair['point_mass']]} minus JSBSim"
        tables.append(PlainTable(title, "Difference", head, rows))
    return tables


def model_table(flights: Flights, document: Document, titles: dict[str, str]) -> PlainTable:
    """Inner loop and models: how each command was answered, and what the models are wrong by."""
    head = []
    for axis in AXES:
        head += [with_unit(f"{axis.short_title}, RMS", axis.unit), "delay [s]"]
    head += ["Drag of the law, RMS [kN]", "as effectiveness", "Drag of the estimator, RMS [kN]"]
    head += ["as effectiveness", "Thrust model, RMS [kN]"]
    rows: list[tuple[str, list[Cell]]] = []
    for label in flights:
        cells: list[Cell] = []
        for axis in AXES:
            place: Path = ("flights", label, "response", axis.key)
            cells += [
                linked_number(document, (*place, "rms"), 2),
                linked_number(document, (*place, "delay_s"), 2),
            ]
        for name in Residuals._fields:
            place = ("flights", label, "model_residuals", f"{name}_kn")
            cells.append(linked_number(document, (*place, "rms"), 3))
            if name != "thrust":
                cells.append(linked_number(document, (*place, "as_effectiveness_median"), 4))
        rows.append((titles[label], cells))
    return PlainTable("", "Flight", head, rows)


def estimator_table(flights: Flights, document: Document, titles: dict[str, str]) -> PlainTable:
    """Parts of the time inside the 95 % bounds, and what the filter could not see."""
    first, *others = (QUANTITIES[name].title.lower() for name in INNOVATIONS)
    head = ["NIS inside", f"Innovation inside: {first}", *others]
    head += ["Largest innovation [σ]", "Effectiveness inside ±2σ", "Thrust not observable"]
    rows: list[tuple[str, list[Cell]]] = []
    for label in flights:
        at = ("flights", label)
        keys = [
            "nis_inside_fraction",
            *(f"innovation_{name}_inside_fraction" for name in INNOVATIONS),
        ]
        cells: list[Cell] = [_percent(document, (*at, key)) for key in keys]
        peaks = [f"innovation_{name}_peak_sigmas" for name in INNOVATIONS]
        largest = max(peaks, key=lambda key: document["flights"][label][key] or 0.0)
        cells.append(linked_number(document, (*at, largest), 1))
        cells.append(_percent(document, (*at, "effectiveness_thrust_inside_fraction")))
        cells.append(_percent(document, (*at, "unobservable_fraction", "thrust")))
        rows.append((titles[label], cells))
    return PlainTable("", "Flight", head, rows)


def stability_table(
    flights: Flights, document: Document, titles: dict[str, str]
) -> PlainTable | None:
    """Of the flights that the theory is about; None without any."""
    rows: list[tuple[str, list[Cell]]] = []
    for label in flights:
        found = document["flights"][label]["stability"]
        if found is None:
            continue
        at = ("flights", label, "stability")
        keys = (
            "decay_rate_per_s", "disturbance", "ball_radius", "predicted_error", "largest_error",
        )  # fmt: skip
        cells: list[Cell] = [linked_number(document, (*at, key), 2) for key in keys]
        cells.append("yes" if found["bound_obeyed"] else "no")
        rows.append((titles[label], cells))
    head = ["λ [1/s]", "φ", "Radius of the ball", "Largest error predicted", "Largest error"]
    head += ["Obeys"]
    return PlainTable("", "Flight", head, rows) if rows else None


def _percent(document: Document, path: Path) -> Markup:
    number = linked_number(document, path, 1, PERCENT, rounded=True)
    return Markup("–") if number.value is None else Markup("{}\u202f%").format(number)
