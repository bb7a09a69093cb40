"""The paper's Figure 3: flown paths in space."""

import string
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from ftc_jsb.recording.flight import Flight
from ftc_jsb.report.fault_times import onset
from ftc_jsb.report.figures.panels import (
    by_model,
    head_column,
    legend,
    loop_styles,
    thinned,
)
from ftc_jsb.report.figures.style import RC, REFERENCE, width
from ftc_jsb.report.flight_groups import Flights
from ftc_jsb.report.titles import loop_title
from ftc_jsb.vocabulary.quantities import QUANTITIES

AXES = ("east", "north", "altitude")


def trajectories(flights: Flights, wide: float | None = None) -> Figure:
    """Figure 3: north, east and altitude, and the reference path; a dot where the fault sets in."""
    columns, styles = by_model(flights), loop_styles(flights)
    with mpl.rc_context(RC):
        figure = plt.figure(figsize=(width(len(columns), wide), 3.0 if len(columns) == 1 else 2.5))
        for number, (title, members) in enumerate(columns.items()):
            axes: Any = figure.add_subplot(1, len(columns), number + 1, projection="3d")
            path = thinned(max(members, key=lambda f: f.record["time"][-1]).record)
            axes.plot(*(QUANTITIES[name].shown(path[f"{name}_ref"]) for name in AXES), **REFERENCE)
            for flight in members:
                _draw(axes, flight, styles[loop_title(flight.scenario)])
            letter = f"({string.ascii_lowercase[number]}) " if len(columns) > 1 else ""
            head_column(axes, f"{letter}{title}", len(columns))
            axes.set_xlabel(QUANTITIES["east"].axis_label, labelpad=-6)
            axes.set_ylabel(QUANTITIES["north"].axis_label, labelpad=-4)
            axes.set_zlabel(QUANTITIES["altitude"].axis_label, labelpad=-3)
            axes.tick_params(pad=-3, labelsize=6.5)
            axes.tick_params(axis="z", pad=0)
            axes.set_box_aspect((1.0, 1.6, 0.8), zoom=1.05 if len(columns) == 1 else 0.85)
            axes.view_init(elev=24, azim=-60)
            axes.xaxis.set_major_locator(mpl.ticker.MaxNLocator(4))
            axes.yaxis.set_major_locator(mpl.ticker.MaxNLocator(5))
            axes.zaxis.set_major_locator(mpl.ticker.MaxNLocator(4))
        legend(figure, flights, reference="reference", faults=False)
    return figure


def _draw(axes: Any, flight: Flight, style: dict[str, Any]) -> None:
    record = thinned(flight.record)
    axes.plot(*(QUANTITIES[name].shown(record[name]) for name in AXES), **style)
    fault = onset(flight)
    if fault is not None:
        row = flight.record[np.searchsorted(flight.record["time"], fault)]
        axes.plot(
            *([QUANTITIES[name].shown(row[name])] for name in AXES),
            marker="o", markersize=3.5, color=style["color"],
        )  # fmt: skip
