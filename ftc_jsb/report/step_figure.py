"""Figure of an aircraft's step responses at its airspeeds."""

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from ftc_jsb.inner_loop_design.published_steps import Steps, step_window
from ftc_jsb.report.figures.style import RC, REFERENCE, STYLES


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
            grid[1].plot(time, np.degrees(rows["bank_angle"]), **style)
            grid[1].plot(time, np.degrees(rows["bank_angle_cmd"]), **REFERENCE)
            grid[2].plot(time, np.degrees(rows["sideslip"]), **style)
            record, levels = steps.thrust_flight.record, steps.thrust_flight.levels
            grid[3].plot(record["time"], record["thrust"] / 1e3, **style)
            wanted = np.clip(record["thrust_cmd"], levels[:, 0], levels[:, 2])
            grid[3].plot(record["time"], wanted / 1e3, **REFERENCE)
        for axes, name in zip(
            grid,
            ("Load factor [-]", "Bank angle [deg]", "Sideslip in it [deg]", "Thrust [kN]"),
            strict=True,
        ):
            axes.set_title(name)
            axes.set_xlabel("Time [s]")
        grid[0].legend(loc="lower right")
    return figure
