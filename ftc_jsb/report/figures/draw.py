"""Every figure of a set of flights, drawn into a folder."""

from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure

from ftc_jsb.errors import RecordingError
from ftc_jsb.report.figures.differences import differences
from ftc_jsb.report.figures.estimates import estimates
from ftc_jsb.report.figures.states import controls, states, tracking
from ftc_jsb.report.figures.style import Print, save
from ftc_jsb.report.figures.trajectories import trajectories
from ftc_jsb.report.flight_groups import Flights, by_scenario
from ftc_jsb.vocabulary.channels import CHANNELS

AS_WIDE_AS_A_COLUMN = Print()


def draw_all(flights: Flights, folder: Path, asked: Print = AS_WIDE_AS_A_COLUMN) -> list[str]:
    """Draw every figure, in a sub-folder a scenario where there are several.

    Args:
        flights: by label.
        folder: made if it is not there.
        asked: font, width and formats; by default PDF, SVG and PNG, as wide as a column or a page.

    Returns:
        What was drawn, relative to `folder` and without the suffix.

    Raises:
        RecordingError: the folder cannot be written.
        FigureError: there is no such font.
    """
    family: dict[Any, Any] = {} if asked.checked().font is None else {"font.family": asked.font}
    groups = by_scenario(flights)
    drawn = []
    try:
        for name, members in groups.items():
            place = Path(name) if len(groups) > 1 else Path()
            (folder / place).mkdir(parents=True, exist_ok=True)
            with mpl.rc_context(family):
                for title, figure in _figures(members, asked.width).items():
                    if figure is not None:
                        save(figure, folder / place, title, asked.formats)
                        drawn.append((place / title).as_posix())
    except OSError as error:
        raise RecordingError(f"{folder}: figures cannot be written: {error}") from None
    return drawn


def _figures(flights: Flights, wide: float | None) -> dict[str, Figure | None]:
    return {
        "figure1_states": states(flights, wide),
        "figure2_controls": controls(flights, wide),
        "figure3_trajectories": trajectories(flights, wide),
        "figure4_effectiveness": estimates(flights, wide=wide),
        **_other_channels(flights, wide),
        "tracking_errors": tracking(flights, wide),
        "differences": differences(flights, wide),
    }


def _other_channels(flights: Flights, wide: float | None) -> dict[str, Figure]:
    """Figure 4 again for each further channel that a flight estimates."""
    channels = {c for f in flights.values() for c in f.scenario.loop.estimator.channels}
    return {
        f"figure4_{channel}": estimates(flights, channel, wide)
        for channel in CHANNELS[1:]
        if channel in channels
    }
