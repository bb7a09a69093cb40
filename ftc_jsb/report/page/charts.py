"""What is drawn on the page: charts, their rows and their lines, as data for the page's script."""

from typing import Any, NamedTuple

from ftc_jsb.analysis.command_following import AXES
from ftc_jsb.analysis.filter_health import INNOVATIONS, NIS_BOUND, SIGMAS
from ftc_jsb.analysis.model_residuals import Residuals
from ftc_jsb.analysis.tracking import ERROR_NAMES
from ftc_jsb.analysis.validity import MOTION
from ftc_jsb.report.page.chart_series import STATES, Series
from ftc_jsb.vocabulary.channels import CHANNELS, TRACKED
from ftc_jsb.vocabulary.quantities import QUANTITIES

ONCE = "reference"  # drawn once for a scenario, in ink
LINE = "line"  # in the flight's colour and dash
WIDE = "wide"  # behind a line, broad and pale: what was asked for
BAND = "band"  # a column and its deviation: so many SIGMAS to each side; of one around zero
MARK = "mark"  # over a line, where something holds
BOUND = "bound"  # thin and dotted, in the flight's colour


class Line(NamedTuple):
    """A line of every flight that has the columns."""

    kind: str
    columns: tuple[str, ...]


class Row(NamedTuple):
    """Lines over one time axis."""

    label: str
    lines: tuple[Line, ...]
    bounds: tuple[float, ...] = ()  # constants that are drawn as lines
    span: tuple[float, float] | None = None  # of the axis at first; None = what is there
    decades: int = 0  # between ticks of a logarithmic axis; 0 = linear


TIME, TIMELINE, SPACE, PLAN, PLANE = (
    "time",
    "timeline",
    "space",
    "plan",
    "plane",
)  # what a chart is drawn over


class Chart(NamedTuple):
    """Rows over one time axis, or one row in space, on a plan or over another variable."""

    name: str
    section: str
    title: str
    note: str
    rows: tuple[Row, ...]
    kind: str = TIME
    across: str = ""  # label of the other axis of a PLANE


_TIMELINE = Chart(
    "timeline", "timeline", "What happened when",
    "A bar for each flight, in its colour and in the order of the list above. Dotted: the fault.",
    (), TIMELINE,
)  # fmt: skip


def charts(series: dict[str, Series], eventful: bool = False) -> list[Chart]:
    """The charts that these flights have data for.

    Args:
        series: of each flight.
        eventful: there is something to be seen in the timeline.
    """
    known = {name for flight in series.values() for name in flight.columns}
    found = [_TIMELINE] if eventful else []
    for chart in _all_charts():
        rows = []
        for row in chart.rows:
            lines = tuple(line for line in row.lines if known.issuperset(line.columns))
            if any(line.kind == LINE for line in lines):
                rows.append(row._replace(lines=lines))
        if rows:
            found.append(chart._replace(rows=tuple(rows)))
    return found


def as_data(chart: Chart) -> dict[str, Any]:
    """A chart as the script reads it."""
    rows = [
        {**row._asdict(), "lines": [line._asdict() for line in row.lines]} for row in chart.rows
    ]
    return {
        "name": chart.name,
        "title": chart.title,
        "kind": chart.kind,
        "across": chart.across,
        "rows": rows,
    }


def _all_charts() -> tuple[Chart, ...]:
    return (
        *_flight_charts(),
        *_place_charts(),
        *_validity_charts(),
        *_estimator_charts(),
        Chart(
            "stability", "stability", "V(t) and the ball",
            "Dotted: the bound on V(t), and the radius of the ball (40) around zero error.",
            (
                Row("V(t) of (37)", (_line("lyapunov"), Line(BOUND, ("lyapunov_bound",)))),
                Row("‖e‖, scaled", (_line("scaled_error"), Line(BOUND, ("ball",)))),
            ),
        ),
    )  # fmt: skip


def _flight_charts() -> tuple[Chart, ...]:
    states = [QUANTITIES[name].axis_label for name in TRACKED]
    inputs = [QUANTITIES[channel].short_axis_label for channel in CHANNELS]
    return (
        Chart(
            "positions", "flights", "Position errors",
            "Place minus that on the path that the references make: ahead, right and above are positive.",
            (
                Row("Ahead [m]", (_line("error_along"),)),
                Row("Right [m]", (_line("error_across"),)),
                Row("Above [m]", (_line("error_height"),)),
            ),
        ),
        Chart(
            "states", "flights", "Airspeed, flight path, heading",
            "Thin dark line: reference, output of the command filter. Dotted: the fault.",
            tuple(
                Row(label, (_line(name), _once(f"{name}_ref")))
                for label, name in zip(states, STATES, strict=True)
            ),
        ),
        Chart(
            "errors", "flights", "Tracking errors", "True value minus reference.",
            tuple(
                Row(label, (_line(name),)) for label, name in zip(states, ERROR_NAMES, strict=True)
            ),
        ),
        *(_estimate_chart(channel) for channel in CHANNELS),
        Chart(
            "controls", "flights", "Thrust command, load factor, bank",
            "Commanded thrust is what a healthy engine would deliver.",
            tuple(
                Row(label, (_line(name),))
                for label, name in zip(
                    inputs, ("thrust_command", "load_factor_flown", "bank_angle_flown"), strict=True
                )
            ),
        ),
    )  # fmt: skip


def _place_charts() -> tuple[Chart, ...]:
    altitude, load_factor = QUANTITIES["altitude"].axis_label, QUANTITIES["load_factor"].axis_label
    return (
        Chart(
            "trajectory", "flights", "Trajectory",
            "Dot: the fault sets in. Ring: the time cursor.",
            (Row(altitude, (Line(LINE, ("east", "north", "altitude")),)),),
            SPACE,
        ),
        Chart(
            "track", "flights", "Ground track",
            "North is up. Thin dark line: the path that the references make. Dot: the fault sets in. "
            "Ring: the time cursor.",
            (
                Row(
                    QUANTITIES["north"].axis_label,
                    (Line(LINE, ("east", "north")), Line(ONCE, ("east_ref", "north_ref"))),
                ),
            ),
            PLAN,
            QUANTITIES["east"].axis_label,
        ),
        Chart(
            "vn", "flights", "V–n: load factor over airspeed",
            "Dashed: load factors that the loop may command, the greatest lift at the mass of the "
            "start, and the fastest that the model was fitted at.",
            (Row(load_factor, (Line(LINE, ("equivalent_airspeed", "load_factor_flown")),)),),
            PLANE,
            "Equivalent airspeed [m/s]",
        ),
        Chart(
            "mach_altitude", "flights", "Altitude over Mach number",
            "Dashed: the range that the model was fitted in, and the slowest level flight at the "
            "greatest lift and the mass of the start.",
            (Row(altitude, (Line(LINE, ("mach", "altitude")),)),),
            PLANE,
            "Mach number [-]",
        ),
    )  # fmt: skip


def _validity_charts() -> tuple[Chart, ...]:
    return (
        Chart(
            "differences", "validity", "Point mass minus JSBSim, over time",
            "Same scenario, same outer loop. In the colour of the point mass.",
            (
                *(Row(v.axis_label, (_line(f"difference_{v.name}"),)) for v in MOTION),
                Row("Distance [m]", (_line("difference_position"),)),
            ),
        ),
        Chart(
            "response", "validity", "Inner loop: commanded and achieved",
            "Broad and pale: command times true effectiveness. Line: what was flown.",
            tuple(
                Row(
                    axis.short_axis_label,
                    (Line(WIDE, (f"{axis.name}_wanted",)), _line(f"{axis.name}_flown")),
                )
                for axis in AXES
            ),
        ),
        Chart(
            "residuals", "validity", "Residual of the drag and thrust models",
            "What the loop's own model says minus what was flown.",
            tuple(
                Row(title, (_line(f"residual_{name}"),))
                for title, name in zip(
                    ("Law's drag [kN]", "Filter's drag [kN]", "Thrust [kN]"),
                    Residuals._fields,
                    strict=True,
                )
            ),
        ),
    )  # fmt: skip


def _estimator_charts() -> tuple[Chart, ...]:
    return (
        Chart(
            "innovations", "estimator", "Innovations over their σ, and NIS",
            "Dashed: 95 % bounds. A fault drives them far outside for a moment: zoom in on it.",
            (
                *(
                    Row(
                        f"{QUANTITIES[name].title} [σ]",
                        (_line(f"innovation_{name}"),),
                        (-SIGMAS, SIGMAS),
                        (-5.0, 5.0),
                    )
                    for name in INNOVATIONS
                ),
                Row("NIS [-]", (_line("nis"),), (NIS_BOUND,), decades=3),
            ),
        ),
        Chart(
            "detector", "estimator", "Detector and observability",
            "A fault is declared above the dashed threshold, marked while it is. "
            "Thick on σ: not observable, nothing is learnt there.",
            (
                Row("Statistic [-]", (_line("detector"), Line(MARK, ("declared",))), (1.0,)),
                *(
                    Row(
                        f"σ, {QUANTITIES[channel].title.lower()} [-]",
                        (
                            _line(f"effectiveness_{channel}_deviation"),
                            Line(MARK, (f"effectiveness_{channel}_lost",)),
                        ),
                        decades=1,
                    )
                    for channel in CHANNELS
                ),
            ),
        ),
    )  # fmt: skip


def _estimate_chart(channel: str) -> Chart:
    name, title = f"effectiveness_{channel}", QUANTITIES[channel].title
    return Chart(
        name, "flights", f"{title} effectiveness and its estimate",
        "Thin dark line: the truth. Band: ±2σ, which knows of no error of the drag and thrust models.",
        (
            Row(
                "Effectiveness [-]",
                (
                    Line(BAND, (f"{name}_estimate", f"{name}_deviation")),
                    _line(f"{name}_estimate"),
                    _once(f"{name}_true"),
                ),
            ),
            Row(
                "Error [-]",
                (Line(BAND, (f"{name}_deviation",)), _line(f"{name}_error")),
                span=(-0.05, 0.05),
            ),
        ),
    )  # fmt: skip


def _line(column: str) -> Line:
    return Line(LINE, (column,))


def _once(column: str) -> Line:
    return Line(ONCE, (column,))
