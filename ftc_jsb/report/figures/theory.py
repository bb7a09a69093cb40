"""Figure of a case of the theory: outputs, inputs, estimated effectiveness, V and its bound."""

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from ftc_jsb.report.figures.style import RC, REFERENCE, STYLES
from ftc_jsb.runs.theory import Analysis, TheoryFlight


def theory_figure(analysis: Analysis, flights: dict[str, TheoryFlight]) -> Figure:
    """A column for outputs and one for inputs, below them effectiveness and the proof; a line a loop."""
    case, linear = analysis.case, analysis.linearization
    outputs, inputs = case.system.outputs, case.system.inputs
    rows = max(len(outputs), len(inputs)) + 1
    places = np.cumsum([0, *linear.index[:-1]])
    with mpl.rc_context(RC):
        figure, grid = plt.subplots(rows, 2, figsize=(7.16, 1.3 * rows + 0.6), sharex=True)
        figure.suptitle(case.title, fontsize=8.5)
        for (name, flight), style in zip(flights.items(), STYLES, strict=False):
            history = flight.history
            for row, place in enumerate(places):
                values = history.error[:, place] + history.reference[:, place]
                grid[row, 0].plot(history.time, values, label=name, **style)
            for row in range(len(inputs)):
                grid[row, 1].plot(history.time, history.command[:, row], **style)
            if name == "ftc":
                states = len(case.system.states)
                for place, symbol in enumerate(case.system.fallible):
                    truth = history.effectiveness[:, inputs.index(symbol)]
                    line = STYLES[place % len(STYLES)]
                    grid[-1, 0].plot(
                        history.time, history.estimate[:, states + place], label=f"{symbol}", **line
                    )
                    grid[-1, 0].plot(history.time, truth, **REFERENCE)
                if flight.proof is not None:
                    grid[-1, 1].semilogy(
                        history.time, flight.proof.error + 1e-12, label="‖e‖", **STYLES[0]
                    )
                    grid[-1, 1].semilogy(
                        history.time, flight.proof.predicted + 1e-12, label="predicted", **STYLES[1]
                    )
                for row, place in enumerate(places):
                    grid[row, 0].plot(history.time, history.reference[:, place], **REFERENCE)
        _label(grid, [str(output) for output in outputs], [str(symbol) for symbol in inputs])
        for axes in grid[-1]:
            axes.set_xlabel(f"Time [{case.time_unit}]")
        handles, labels = grid[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=4)
    return figure


def _label(grid: np.ndarray, outputs: list[str], inputs: list[str]) -> None:
    """Names of the axes; panels that nothing is in go."""
    for column, names in enumerate((outputs, inputs)):
        for row in range(len(grid) - 1):
            if row < len(names):
                grid[row, column].set_ylabel(names[row])
            else:
                grid[row, column].set_axis_off()
    grid[-1, 0].set_ylabel("effectiveness")
    grid[-1, 1].set_ylabel("error, bound")
    for axes in grid[-1]:
        if axes.has_data():
            axes.legend(fontsize=6)
