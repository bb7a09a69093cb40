"""Figure of an aircraft's step responses at its airspeeds."""

from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure

from ftc_jsb.inner_loop_design.published_steps import Steps, step_window
from ftc_jsb.report.figures.style import RC, REFERENCE, STYLES
from ftc_jsb.vocabulary.quantities import QUANTITIES


def steps_figure(title: str, flown: list[Steps]) -> Figure:
    """Load factor, bank, its sideslip, and thrust with what a healthy engine could give.

    Args:
        title: of the aircraft.
        flown: its steps, one for each airspeed.
    """
    with mpl.rc_context(RC):
        figure, grid = plt.subplots(1, 4, figsize=(9.0, 2.3))
        figure.suptitle(title)
        for steps, style in zip(flown, STYLES, strict=False):
            label = {"label": f"{steps.airspeed:.0f} m/s"}
            time, rows = step_window(steps.load_factor_flight)
            grid[0].plot(time, rows["load_factor"], **style, **label)
            grid[0].plot(time, rows["load_factor_cmd"], **REFERENCE)
            time, rows = step_window(steps.bank_flight)
            grid[1].plot(time, _shown(rows, "bank_angle"), **style)
            grid[1].plot(time, _shown(rows, "bank_angle_cmd"), **REFERENCE)
            grid[2].plot(time, _shown(rows, "sideslip"), **style)
            record, levels = steps.thrust_flight.record, steps.thrust_flight.levels
            grid[3].plot(record["time"], _shown(record, "thrust"), **style)
            wanted = np.clip(record["thrust_cmd"], levels[:, 0], levels[:, 2])
            grid[3].plot(record["time"], QUANTITIES["thrust"].shown(wanted), **REFERENCE)
        for axes, name in zip(
            grid, ("load_factor", "bank_angle", "sideslip", "thrust"), strict=True
        ):
            quantity = QUANTITIES[name]
            title = f"{quantity.title} in it" if name == "sideslip" else quantity.title
            axes.set_title(f"{title} [{quantity.unit or '-'}]")
            axes.set_xlabel("Time [s]")
        grid[0].legend(loc="lower right")
    return figure


def _shown(rows: npt.NDArray[Any], name: str) -> npt.NDArray[np.float64]:
    return np.asarray(QUANTITIES[name].shown(rows[name]))
