"""The paper's Figure 4: the estimate of an effectiveness, its band, the truth, and the error."""

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ftc_jsb.analysis.effectiveness_estimate import unobservable
from ftc_jsb.recording.flight import Flight
from ftc_jsb.report.fault_times import onset
from ftc_jsb.report.figures.inset import draw_inset, find_inset
from ftc_jsb.report.figures.panels import (
    by_model,
    head_column,
    legend,
    loop_styles,
    mark_faults,
    thinned,
)
from ftc_jsb.report.figures.style import RC, REFERENCE, UNOBSERVABLE, letter_panels, width
from ftc_jsb.report.flight_groups import Flights
from ftc_jsb.report.titles import loop_title
from ftc_jsb.vocabulary.channels import Channel
from ftc_jsb.vocabulary.quantities import QUANTITIES

BEFORE, AFTER = 0.5, 1.5  # [s] around the fault that are magnified
ERRORS = 0.05  # the error's axis ends here at least; what goes beyond is the transient at the fault
MOST = 0.95  # part of the samples of every flight that the error's axis shows


def estimates(flights: Flights, channel: Channel = "thrust", wide: float | None = None) -> Figure:
    """Figure 4 for one channel: estimate, 2-sigma band and truth above, the error below."""
    columns, styles = by_model(flights), loop_styles(flights)
    name = f"effectiveness_{channel}"
    lost, largest = False, ERRORS
    with mpl.rc_context(RC):
        figure, grid = plt.subplots(
            2, len(columns), figsize=(width(len(columns), wide), 3.0), sharex=True, sharey="row",
            squeeze=False, height_ratios=(2, 1),
        )  # fmt: skip
        for column, (title, members) in enumerate(columns.items()):
            upper, lower = grid[0, column], grid[1, column]
            head_column(upper, title, len(columns))
            for flight in members:
                style = styles[loop_title(flight.scenario)]
                record = thinned(flight.record)
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
                largest = max(largest, float(np.nanquantile(np.abs(estimate - truth), MOST)))
            for axes in (upper, lower):
                mark_faults(axes, members[0])
                lost = _mark_unobservable(axes, members[0], channel) or lost
            lower.set_xlabel("Time [s]")
        grid[0, 0].set_ylabel(f"{QUANTITIES[channel].title} effectiveness [-]")
        grid[1, 0].set_ylabel("Error [-]")
        for axes in grid[1]:
            axes.set_ylim(-largest, largest)
        for column, members in enumerate(columns.values()):
            fault = onset(members[0])
            inset = find_inset(grid[0, column], fault, BEFORE, AFTER)
            if inset is not None and fault is not None:
                draw_inset(grid[0, column], inset, fault)
        letter_panels(grid.flat)
        figure.align_ylabels()
        legend(figure, flights, reference="true", unobservable=lost)
    return figure


def _mark_unobservable(axes: Axes, flight: Flight, channel: Channel) -> bool:
    """Grey bands where the measurements tell nothing of the channel; whether there are any."""
    if channel not in flight.scenario.loop.estimator.channels:
        return False
    hidden = unobservable(flight, channel)
    edges = np.flatnonzero(np.diff(np.concatenate([[0], hidden.astype(int), [0]])))
    time = flight.record["time"]
    for start, end in zip(edges[::2], edges[1::2], strict=True):
        axes.axvspan(time[start], time[end - 1], **UNOBSERVABLE)
    return bool(hidden.any())
