"""Every figure of a set of flights, drawn into a folder."""

from pathlib import Path

from matplotlib.figure import Figure

from ftc_jsb.errors import RecordingError
from ftc_jsb.report.figures.differences import differences
from ftc_jsb.report.figures.estimates import estimates
from ftc_jsb.report.figures.states import controls, states, tracking
from ftc_jsb.report.figures.style import save
from ftc_jsb.report.figures.trajectories import trajectories
from ftc_jsb.report.flight_groups import Flights, by_scenario
from ftc_jsb.vocabulary.channels import CHANNELS


def draw_all(flights: Flights, folder: Path) -> list[str]:
    """Draw every figure as PDF, SVG and PNG, in a sub-folder a scenario where there are several.

    Returns:
        What was drawn, relative to `folder` and without the suffix.

    Raises:
        RecordingError: the folder cannot be written.
    """
    groups = by_scenario(flights)
    drawn = []
    try:
        for name, members in groups.items():
            place = Path(name) if len(groups) > 1 else Path()
            (folder / place).mkdir(parents=True, exist_ok=True)
            for title, figure in _figures(members).items():
                if figure is not None:
                    save(figure, folder / place, title)
                    drawn.append((place / title).as_posix())
    except OSError as error:
        raise RecordingError(f"{folder}: figures cannot be written: {error}") from None
    return drawn


def _figures(flights: Flights) -> dict[str, Figure | None]:
    return {
        "figure1_states": states(flights),
        "figure2_controls": controls(flights),
        "figure3_trajectories": trajectories(flights),
        "figure4_effectiveness": estimates(flights),
        **_other_channels(flights),
        "tracking_errors": tracking(flights),
        "differences": differences(flights),
    }


def _other_channels(flights: Flights) -> dict[str, Figure]:
    """Figure 4 again for each further channel that a flight estimates."""
    channels = {c for f in flights.values() for c in f.scenario.loop.estimator.channels}
    return {
        f"figure4_{channel}": estimates(flights, channel)
        for channel in CHANNELS[1:]
        if channel in channels
    }
