"""Figure of the outer loop's frequency response, with the margins found by inserting them."""

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from ftc_jsb.margins.document import decibel
from ftc_jsb.margins.measure import ChannelMargins
from ftc_jsb.report.figures.style import RC, STYLES
from ftc_jsb.vocabulary.quantities import QUANTITIES

INSERTED: dict[str, Any] = {"color": STYLES[1]["color"], "markersize": 5, "linestyle": "none"}


def bode_figure(title: str, found: Sequence[ChannelMargins]) -> Figure:
    """A column for each input: size, phase and coherence of L; triangles are the inserted margins."""
    with mpl.rc_context(RC):
        figure, grid = plt.subplots(
            3,
            len(found),
            figsize=(2.6 * len(found), 5.4),
            sharex=True,
            sharey="row",
            squeeze=False,
            height_ratios=(3, 3, 1),
        )
        figure.suptitle(title, fontsize=8.5)
        for column, each in enumerate(found):
            size, phase, coherence = grid[:, column]
            response, c = each.response, each.classical
            angle = np.degrees(np.unwrap(np.angle(response.loop)))
            size.set_title(QUANTITIES[each.channel].title)
            size.semilogx(response.frequency, _decibel_of(response.loop), **STYLES[0])
            size.axhline(0.0, color="#222222", lw=0.7)
            phase.semilogx(response.frequency, angle, **STYLES[0])
            phase.axhline(-180.0, color="#222222", lw=0.7)
            coherence.semilogx(response.frequency, response.coherence, **STYLES[0])
            if np.isfinite(each.gain) and np.isfinite(c.phase_crossover):
                size.plot(c.phase_crossover, -decibel(each.gain), marker="v", **INSERTED)
                for axes in (size, phase):
                    axes.axvline(c.phase_crossover, color="#222222", lw=0.7, ls=":")
            if np.isfinite(each.delay) and np.isfinite(c.gain_crossover):
                lag = np.degrees(each.delay * c.gain_crossover)
                phase.plot(c.gain_crossover, lag - 180.0, marker="^", **INSERTED)
                for axes in (size, phase):
                    axes.axvline(c.gain_crossover, color="#222222", lw=0.7, ls="--")
            coherence.set_xlabel("Frequency [rad/s]")
        grid[0, 0].set_ylabel("|L| [dB]")
        grid[1, 0].set_ylabel("Phase of L [°]")
        turned = [np.unwrap(np.angle(each.response.loop)).min() for each in found]
        lowest = min(-270.0, *(90.0 * np.floor(np.degrees(value) / 90.0) for value in turned))
        grid[1, 0].set_ylim(lowest - 10.0, 0.0)
        grid[1, 0].set_yticks(np.arange(lowest, 1.0, 90.0 if lowest > -500.0 else 180.0))
        grid[2, 0].set_ylabel("Coherence")
        grid[2, 0].set_ylim(0.0, 1.05)
    return figure


def _decibel_of(loop: Any) -> Any:
    """Size of a complex array in dB."""
    return 20.0 * np.log10(np.abs(loop))
