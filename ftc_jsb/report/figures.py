"""The paper's Figures 1-4 for every model, and the difference between the models, with matplotlib."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ftc_jsb.disturbance.faults import fault_steps
from ftc_jsb.metrics import unobservable
from ftc_jsb.report.validity import COMPARED
from ftc_jsb.report.words import loop_title, model_title
from ftc_jsb.scenario.limits import tracking_errors
from ftc_jsb.scenario.schema import CHANNELS, Channel
from ftc_jsb.simulation.flight import Flight

Flights = dict[str, Flight]
Array = npt.NDArray[np.float64]

# Okabe and Ito's colours, told apart by every eye; dashes tell them apart in grey.
STYLES: tuple[dict[str, Any], ...] = (
    {"color": "#0072B2", "linestyle": "-"},
    {"color": "#D55E00", "linestyle": (0, (4, 1.5))},
    {"color": "#009E73", "linestyle": (0, (1, 1))},
    {"color": "#CC79A7", "linestyle": (0, (5, 1, 1, 1))},
    {"color": "#56B4E9", "linestyle": (0, (2, 1))},
)
REFERENCE: dict[str, Any] = {"color": "#222222", "linestyle": "-", "linewidth": 0.7}
CHANNEL_TITLES = {"thrust": "Thrust", "load_factor": "Load factor", "bank_angle": "Bank angle"}
UNOBSERVABLE: dict[str, Any] = {"color": "#bbbbbb", "alpha": 0.35, "lw": 0}
POINTS = 1500  # of a line; more cannot be seen

RC: dict[Any, Any] = {
    "font.size": 8.0,
    "axes.titlesize": 8.5,
    "axes.labelsize": 8.0,
    "axes.grid": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.5,
    "lines.linewidth": 1.1,
    "legend.frameon": False,
    "legend.fontsize": 8.0,
    "figure.constrained_layout.use": True,
    "svg.fonttype": "none",
    "svg.hashsalt": "ftc-jsb",
    "pdf.fonttype": 42,
}


def states(flights: Flights) -> Figure:
    """Figure 1: airspeed, flight path angle and heading with their references."""
    rows = (
        ("airspeed", "Airspeed [m/s]", _same),
        ("flight_path_angle", "Flight path [deg]", np.degrees),
        ("heading", "Heading [deg]", np.degrees),
    )
    return _grid(flights, rows, reference=True)


def tracking(flights: Flights) -> Figure:
    """Tracking errors: airspeed, flight path angle and heading minus their references."""
    rows = (
        ("error_airspeed", "Airspeed error [m/s]", _same),
        ("error_flight_path_deg", "Path error [deg]", _same),
        ("error_heading_deg", "Heading error [deg]", _same),
    )
    return _grid(flights, rows, reference=False)


def controls(flights: Flights) -> Figure:
    """Figure 2: commanded thrust, and load factor and bank angle as flown."""
    rows = (
        ("thrust_cmd", "Thrust command [kN]", _kilo),
        ("load_factor", "Load factor [-]", _same),
        ("bank_angle", "Bank angle [deg]", np.degrees),
    )
    return _grid(flights, rows, reference=False)


def trajectories(flights: Flights) -> Figure:
    """Figure 3: the flown paths in space."""
    columns, styles = by_model(flights), _styles(flights)
    with mpl.rc_context(RC):
        figure = plt.figure(figsize=(3.1 * len(columns), 3.6))
        for number, (title, members) in enumerate(columns.items()):
            axes: Any = figure.add_subplot(1, len(columns), number + 1, projection="3d")
            for flight in members:
                style = styles[loop_title(flight.scenario)]
                record = _thinned(flight.record)
                axes.plot(
                    record["east"] / 1e3, record["north"] / 1e3, record["altitude"] / 1e3, **style
                )
                fault = fault_steps(flight.record["effectiveness_thrust"], flight.scenario)
                if fault.size:
                    row = flight.record[fault[0]]
                    axes.plot(
                        [row["east"] / 1e3], [row["north"] / 1e3], [row["altitude"] / 1e3],
                        marker="o", markersize=3.5, color=style["color"],
                    )  # fmt: skip
            axes.set_title(title)
            axes.set_xlabel("East [km]", labelpad=-4)
            axes.set_ylabel("North [km]", labelpad=-2)
            axes.set_zlabel("Altitude [km]", labelpad=-2)
            axes.tick_params(pad=-2, labelsize=6.5)
            axes.set_box_aspect((1.0, 1.6, 0.8), zoom=0.82)
            axes.view_init(elev=24, azim=-60)
            axes.xaxis.set_major_locator(mpl.ticker.MaxNLocator(4))
            axes.zaxis.set_major_locator(mpl.ticker.MaxNLocator(5))
        _legend(figure, flights, reference=False)
    return figure


def estimates(flights: Flights, channel: Channel = "thrust") -> Figure:
    """Figure 4: estimate of a channel's effectiveness, its 2-sigma band, the truth, and the error.

    Grey where the channel is not observable.
    """
    columns, styles = by_model(flights), _styles(flights)
    name = f"effectiveness_{channel}"
    with mpl.rc_context(RC):
        figure, grid = plt.subplots(
            2, len(columns), figsize=(3.1 * len(columns), 3.6), sharex=True, sharey="row",
            squeeze=False, height_ratios=(2, 1),
        )  # fmt: skip
        for column, (title, members) in enumerate(columns.items()):
            upper, lower = grid[0, column], grid[1, column]
            upper.set_title(title)
            for flight in members:
                style = styles[loop_title(flight.scenario)]
                record = _thinned(flight.record)
                time, truth = record["time"], record[name]
                estimate, band = record[f"{name}_est"], 2.0 * record[f"{name}_std"]
                upper.plot(time, truth, **REFERENCE)
                if not np.isfinite(estimate).any():
                    continue
                upper.plot(time, estimate, **style)
                upper.fill_between(
                    time, estimate - band, estimate + band, color=style["color"], alpha=0.2, lw=0
                )
                lower.plot(time, estimate - truth, **style)
            for axes in (upper, lower):
                _mark_faults(axes, members)
                _mark_unobservable(axes, members[0], channel)
            lower.set_xlabel("Time [s]")
        grid[0, 0].set_ylabel(f"{CHANNEL_TITLES[channel]} effectiveness [-]")
        grid[1, 0].set_ylabel("Error [-]")
        for axes in grid[1]:
            axes.set_ylim(-0.05, 0.05)
        _legend(figure, flights, reference=True, reference_title="true", unobservable_title=True)
    return figure


def _mark_unobservable(axes: Axes, flight: Flight, channel: Channel) -> None:
    """Grey bands where the measurements tell nothing of the channel."""
    if channel not in flight.scenario.loop.estimator.channels:
        return
    hidden = unobservable(flight, channel)
    edges = np.flatnonzero(np.diff(np.concatenate([[0], hidden.astype(int), [0]])))
    time = flight.record["time"]
    for start, end in zip(edges[::2], edges[1::2], strict=True):
        axes.axvspan(time[start], time[end - 1], **UNOBSERVABLE)


def differences(flights: Flights) -> Figure | None:
    """What the point masses say minus what the 6-DOF aircraft did, loop by loop; None without both."""
    pairs, styles = model_pairs(flights), _styles(flights)
    if not pairs:
        return None
    with mpl.rc_context(RC):
        figure, grid = plt.subplots(
            len(COMPARED), len(pairs),
            figsize=(3.1 * max(len(pairs), 2), 1.05 * len(COMPARED) + 0.7),
            sharex=True, squeeze=False,
        )  # fmt: skip
        for column, (title, couples) in enumerate(pairs.items()):
            grid[0, column].set_title(f"{title} minus JSBSim")
            for row, (name, quantity, unit, factor) in enumerate(COMPARED):
                axes = grid[row, column]
                for point_mass, six_dof in couples:
                    style = styles[loop_title(point_mass.scenario)]
                    count = min(point_mass.record.size, six_dof.record.size)
                    one, other = point_mass.record[:count], six_dof.record[:count]
                    difference = factor * (one[name] - other[name])
                    step = max(count // POINTS, 1)
                    axes.plot(one["time"][::step], difference[::step], **style)
                _mark_faults(axes, [six_dof for _, six_dof in couples])
                if column == 0:
                    axes.set_ylabel(f"{quantity} [{unit or '-'}]")
            grid[-1, column].set_xlabel("Time [s]")
        figure.align_ylabels()
        _legend(figure, flights, reference=False)
    return figure


def model_pairs(flights: Flights) -> dict[str, list[tuple[Flight, Flight]]]:
    """Point-mass model title to its (point mass, JSBSim) flights with the same loop."""
    pairs: dict[str, list[tuple[Flight, Flight]]] = {}
    six_dof = {
        flight.scenario.loop.name: flight
        for flight in flights.values()
        if flight.scenario.model == "jsbsim"
    }
    for flight in flights.values():
        other = six_dof.get(flight.scenario.loop.name)
        if flight.scenario.model != "jsbsim" and other is not None:
            pairs.setdefault(model_title(flight.scenario), []).append((flight, other))
    return pairs


def draw_all(flights: Flights, folder: Path) -> dict[str, str]:
    """Draw every figure into `folder` as SVG, PNG and PDF; returns the SVG text by name."""
    folder.mkdir(exist_ok=True)
    drawn: dict[str, Figure | None] = {
        "figure1_states": states(flights),
        "figure2_controls": controls(flights),
        "tracking_errors": tracking(flights),
        "figure3_trajectories": trajectories(flights),
        "figure4_effectiveness": estimates(flights),
        **_other_channels(flights),
        "differences": differences(flights),
    }
    texts = {}
    for name, figure in drawn.items():
        if figure is None:
            continue
        with mpl.rc_context(RC):
            figure.savefig(folder / f"{name}.svg", metadata={"Date": None})
            figure.savefig(folder / f"{name}.png", dpi=200)
            figure.savefig(folder / f"{name}.pdf", metadata={"CreationDate": None})
        plt.close(figure)
        texts[name] = (folder / f"{name}.svg").read_text(encoding="utf-8")
    return texts


def _other_channels(flights: Flights) -> dict[str, Figure]:
    """Figure 4 again for each further channel that a flight estimates."""
    channels = {c for f in flights.values() for c in f.scenario.loop.estimator.channels}
    return {
        f"figure4_{channel}": estimates(flights, channel)
        for channel in CHANNELS[1:]
        if channel in channels
    }


def by_model(flights: Flights) -> dict[str, list[Flight]]:
    """Flights by the title of their model, in the order flown."""
    several = len({flight.scenario.name for flight in flights.values()}) > 1
    columns: dict[str, list[Flight]] = {}
    for flight in flights.values():
        title = model_title(flight.scenario)
        title = f"{flight.scenario.name}: {title}" if several else title
        columns.setdefault(title, []).append(flight)
    return columns


def _grid(
    flights: Flights,
    rows: tuple[tuple[str, str, Callable[[Array], Array]], ...],
    reference: bool,
) -> Figure:
    """A column for each model, a row for each variable, a line for each loop."""
    columns, styles = by_model(flights), _styles(flights)
    with mpl.rc_context(RC):
        figure, grid = plt.subplots(
            len(rows), len(columns), figsize=(3.1 * len(columns), 1.45 * len(rows) + 0.6),
            sharex=True, sharey="row", squeeze=False,
        )  # fmt: skip
        for column, (title, members) in enumerate(columns.items()):
            grid[0, column].set_title(title)
            for row, (name, label, convert) in enumerate(rows):
                axes = grid[row, column]
                for flight in members:
                    style = styles[loop_title(flight.scenario)]
                    record = _thinned(flight.record)
                    axes.plot(record["time"], convert(_column(record, name)), **style)
                if reference:
                    record = _thinned(members[0].record)
                    axes.plot(record["time"], convert(record[f"{name}_ref"]), **REFERENCE)
                _mark_faults(axes, members)
                if column == 0:
                    axes.set_ylabel(label)
            grid[-1, column].set_xlabel("Time [s]")
        figure.align_ylabels()
        _legend(figure, flights, reference)
    return figure


def _legend(
    figure: Figure,
    flights: Flights,
    reference: bool,
    reference_title: str = "reference",
    unobservable_title: bool = False,
) -> None:
    styles = _styles(flights)
    lines: list[Any] = [mpl.lines.Line2D([], [], **style) for style in styles.values()]
    titles = list(styles)
    if reference:
        lines.append(mpl.lines.Line2D([], [], **REFERENCE))
        titles.append(reference_title)
    if unobservable_title:
        lines.append(mpl.patches.Patch(**UNOBSERVABLE))
        titles.append("not observable here")
    figure.legend(lines, titles, loc="outside lower center", ncols=len(titles))


def _styles(flights: Flights) -> dict[str, dict[str, Any]]:
    """A style for each loop, the same in every column and in the legend."""
    titles = dict.fromkeys(loop_title(flight.scenario) for flight in flights.values())
    return {title: STYLES[number % len(STYLES)] for number, title in enumerate(titles)}


def _mark_faults(axes: Axes, members: list[Flight]) -> None:
    """Dotted lines where the thrust effectiveness steps."""
    for step in fault_steps(members[0].record["effectiveness_thrust"], members[0].scenario)[:20]:
        time = members[0].record["time"][step]
        axes.axvline(time, color="#888888", linewidth=0.7, linestyle=":")


def _thinned(record: npt.NDArray[Any]) -> npt.NDArray[Any]:
    return record[:: max(record.size // POINTS, 1)]


def _column(record: npt.NDArray[Any], name: str) -> Array:
    return tracking_errors(record)[name] if name.startswith("error_") else record[name]


def _same(values: Array) -> Array:
    return values


def _kilo(values: Array) -> Array:
    return values / 1e3
