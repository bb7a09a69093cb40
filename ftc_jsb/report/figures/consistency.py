"""Figure of NEES and NIS over many flights, with their bands."""

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from ftc_jsb.analysis.consistency import Consistency
from ftc_jsb.report.figures.style import RC, STYLES


def consistency_figure(found: dict[int, Consistency], dt: float) -> Figure:
    """A column for each number of estimated channels; NEES above, NIS below.

    Args:
        found: by number of channels.
        dt: sample time [s].
    """
    with mpl.rc_context(RC):
        figure, grid = plt.subplots(
            2, len(found), figsize=(3.4 * len(found), 3.6), sharex=True, squeeze=False
        )
        for column, (channels, result) in enumerate(found.items()):
            title = f"{channels} channel{'s' if channels > 1 else ''} estimated"
            grid[0, column].set_title(title)
            for axes, values, (low, high) in (
                (grid[0, column], result.nees, result.nees_band),
                (grid[1, column], result.nis, result.nis_band),
            ):
                time = dt * np.arange(1, len(values) + 1)
                axes.plot(time, values, **STYLES[0] | {"linewidth": 0.7})
                axes.axhspan(low, high, color="#bbbbbb", alpha=0.5, lw=0)
                axes.set_ylim(low - (high - low), high + (high - low))
            grid[1, column].set_xlabel("Time [s]")
        grid[0, 0].set_ylabel("NEES, mean of flights")
        grid[1, 0].set_ylabel("NIS, mean of flights")
    return figure
