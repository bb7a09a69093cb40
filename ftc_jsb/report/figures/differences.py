"""What the point masses say minus what the 6-DOF aircraft did, over time."""

import matplotlib as mpl
import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from ftc_jsb.analysis.validity import MOTION, compared
from ftc_jsb.recording.flight import Flight
from ftc_jsb.report.figures.panels import legend, loop_styles, mark_faults
from ftc_jsb.report.figures.style import POINTS, RC, letter_panels, width
from ftc_jsb.report.flight_groups import Flights, model_pairs
from ftc_jsb.report.titles import loop_title, model_title


def differences(flights: Flights, wide: float | None = None) -> Figure | None:
    """A column for each point mass, a row for each variable; None without both models."""
    columns: dict[str, list[tuple[Flight, Flight]]] = {}
    for label, partner in model_pairs(flights):
        point_mass, six_dof = flights[label], flights[partner]
        columns.setdefault(model_title(point_mass.scenario), []).append((point_mass, six_dof))
    if not columns:
        return None
    styles = loop_styles(flights)
    with mpl.rc_context(RC):
        figure, grid = plt.subplots(
            len(MOTION), len(columns), figsize=(width(len(columns), wide), 0.95 * len(MOTION) + 0.7),
            sharex=True, squeeze=False,
        )  # fmt: skip
        for column, (title, couples) in enumerate(columns.items()):
            grid[0, column].set_title(f"{title} minus JSBSim")
            for row, variable in enumerate(MOTION):
                axes = grid[row, column]
                for point_mass, six_dof in couples:
                    time, one, other = compared(variable, point_mass, six_dof)
                    step = max(time.size // POINTS, 1)
                    style = styles[loop_title(point_mass.scenario)]
                    axes.plot(time[::step], (one - other)[::step], **style)
                mark_faults(axes, couples[0][0])
                if column == 0:
                    axes.set_ylabel(f"{variable.title}\n[{variable.unit or '-'}]")
            grid[-1, column].set_xlabel("Time [s]")
        letter_panels(grid.flat)
        figure.align_ylabels()
        legend(figure, flights)
    return figure
