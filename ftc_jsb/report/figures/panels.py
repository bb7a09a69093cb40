"""Panels of a figure: a column for each model, a row for each variable, a line for each loop."""

from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ftc_jsb.analysis.tracking import values_of
from ftc_jsb.recording.flight import Flight
from ftc_jsb.report.fault_times import fault_times, onset
from ftc_jsb.report.figures.inset import draw_inset, find_inset
from ftc_jsb.report.figures.style import (
    FAULT,
    POINTS,
    RC,
    REFERENCE,
    STYLES,
    UNOBSERVABLE,
    letter_panels,
    width,
)
from ftc_jsb.report.flight_groups import Flights
from ftc_jsb.report.titles import loop_title, model_title
from ftc_jsb.vocabulary.quantities import Quantity

BEFORE, AFTER = 1.0, 4.0  # [s] around the fault that are magnified
MAGNIFIED = 1.5  # height of a row with insets, of that of another
ROOM = 0.7  # of a panel's height, that is added below where an inset has no room


def panels(
    flights: Flights, rows: dict[str, Quantity], reference: bool, wide: float | None = None
) -> Figure:
    """A figure of variables over time, of flights of one scenario.

    Args:
        flights: by label.
        rows: by the label of their axis.
        reference: whether each variable has one, which is drawn once a model.
        wide: width [in], where one is asked for.
    """
    columns, styles = by_model(flights), loop_styles(flights)
    heights = [MAGNIFIED if any(map(fault_times, flights.values())) else 1.0] + [1.0] * (
        len(rows) - 1
    )
    with mpl.rc_context(RC):
        figure, grid = plt.subplots(
            len(rows), len(columns), figsize=(width(len(columns), wide), 1.2 * sum(heights) + 0.6),
            sharex=True, sharey="row", squeeze=False, height_ratios=heights,
        )  # fmt: skip
        for column, (title, members) in enumerate(columns.items()):
            head_column(grid[0, column], title, len(columns))
            for number, (label, quantity) in enumerate(rows.items()):
                axes = grid[number, column]
                for flight in members:
                    style = styles[loop_title(flight.scenario)]
                    record = thinned(flight.record)
                    values = quantity.shown(values_of(record, quantity.name))
                    axes.plot(record["time"], values, **style)
                if reference:
                    record = thinned(members[0].record)
                    values = quantity.shown(record[f"{quantity.name}_ref"])
                    axes.plot(record["time"], values, **REFERENCE)
                mark_faults(axes, members[0])
                if column == 0:
                    axes.set_ylabel(label)
            grid[-1, column].set_xlabel("Time [s]")
        _magnify(grid[0], [onset(members[0]) for members in columns.values()])
        letter_panels(grid.flat)
        figure.align_ylabels()
        legend(figure, flights, reference="reference" if reference else None)
    return figure


def _magnify(row: npt.NDArray[Any], faults: list[float | None]) -> None:
    """An inset around the fault in every panel of a row; the row gets room below where it has none."""
    for room in (0.0, ROOM):
        low, high = row[0].get_ylim()
        row[0].set_ylim(low - room * (high - low), high)
        insets = [find_inset(*each, BEFORE, AFTER) for each in zip(row, faults, strict=True)]
        if all(inset is not None for inset in insets):
            for axes, inset, fault in zip(row, insets, faults, strict=True):
                if inset is not None and fault is not None:
                    draw_inset(axes, inset, fault)
            return
    row[0].set_ylim(low, high)


def head_column(axes: Axes, title: str, columns: int) -> None:
    """The model's name above its column; above a single one the caption says it."""
    if columns > 1:
        axes.set_title(title)


def by_model(flights: Flights) -> dict[str, list[Flight]]:
    """Flights by the title of their model, in the order flown."""
    columns: dict[str, list[Flight]] = {}
    for flight in flights.values():
        columns.setdefault(model_title(flight.scenario), []).append(flight)
    return columns


def loop_styles(flights: Flights) -> dict[str, dict[str, Any]]:
    """A style for each loop, the same in every column and in the legend."""
    titles = dict.fromkeys(loop_title(flight.scenario) for flight in flights.values())
    return {title: STYLES[number % len(STYLES)] for number, title in enumerate(titles)}


def mark_faults(axes: Axes, flight: Flight) -> None:
    """Dotted lines where faults set in or end."""
    for time in fault_times(flight):
        axes.axvline(time, **FAULT)


def legend(
    figure: Figure,
    flights: Flights,
    reference: str | None = None,
    unobservable: bool = False,
    faults: bool = True,
) -> None:
    """A line for each loop below the figure, and what else is drawn."""
    styles = loop_styles(flights)
    entries: dict[str, Any] = {
        title: mpl.lines.Line2D([], [], **style) for title, style in styles.items()
    }
    if reference:
        entries[reference] = mpl.lines.Line2D([], [], **REFERENCE)
    if faults and any(map(fault_times, flights.values())):
        entries["fault"] = mpl.lines.Line2D([], [], **FAULT)
    if unobservable:
        entries["not observable here"] = mpl.patches.Patch(**UNOBSERVABLE)
    narrow = figure.get_figwidth() < 5.0  # [in]
    figure.legend(
        list(entries.values()), list(entries), loc="outside lower center",
        ncols=min(len(entries), 2 if narrow and len(entries) > 3 else 5), columnspacing=1.0, handlelength=1.8,
    )  # fmt: skip


def thinned(record: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """As many rows as a line needs."""
    return record[:: max(record.size // POINTS, 1)]
