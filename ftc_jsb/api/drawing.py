"""Figures and reports of the flights that a user of the package holds."""

from collections.abc import Callable, Mapping
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from ftc_jsb.recording.flight import Flight

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Drawn = TypeVar("Drawn", bound="Figure | None")


def draw(flights: Mapping[str, Flight], what: str) -> "Figure":
    """A figure of flights of one scenario, not shown and not kept by pyplot.

    Raises:
        ValueError: no such figure, or the flights have no data for it.
    """
    from ftc_jsb.report.figures.estimates import estimates
    from ftc_jsb.report.figures.states import controls, states, tracking
    from ftc_jsb.report.figures.trajectories import trajectories

    drawings: dict[str, Callable[[Mapping[str, Flight]], Figure | None]] = {
        "states": states,
        "controls": controls,
        "errors": tracking,
        "trajectory": trajectories,
        "effectiveness": estimates,
    }
    if what not in drawings:
        raise ValueError(f"plot({what!r}): expected one of {', '.join(drawings)}")
    figure = unshown(lambda: drawings[what](flights))
    if figure is None:
        raise ValueError(f"plot({what!r}): these flights have no data for it")
    return figure


def unshown(drawing: Callable[[], Drawn]) -> Drawn:
    """A figure that pyplot does not keep: a notebook would show it twice.

    Matplotlib loads its backend with the first figure. In a notebook that switches on the showing of
    figures, for good; inside of a drawing, whose settings end with it, that would be taken back, and no
    later figure be seen.
    """
    import matplotlib.pyplot as plt

    plt.close(plt.figure())
    figure = drawing()
    if figure is not None:
        plt.close(figure)
    return figure


def report(flights: Mapping[str, Flight], folder: str | PathLike[str], force: bool) -> Path:
    """Write the report of flights; the path of its page.

    Raises:
        RecordingError: the folder is not empty and `force` is not given, or cannot be written.
    """
    from ftc_jsb.report.page.write import write_report
    from ftc_jsb.runs.output_folder import output_folder

    with output_folder(Path(folder), "report", force, "report folder") as place:
        write_report(flights, place, "ftc_jsb: report()")
    return Path(folder) / "report.html"
