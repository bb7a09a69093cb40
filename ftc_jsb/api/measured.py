"""`identify` and `margins`: what many flights are flown to find."""

from collections.abc import Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from ftc_jsb.api.announcement import Bar, compiling
from ftc_jsb.api.drawing import unshown
from ftc_jsb.errors import WriteError

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

    from ftc_jsb.margins.measure import ChannelMargins
    from ftc_jsb.scenario import schema


class Identification:
    """A point mass fitted to virtual flight tests."""

    def __init__(self, contents: dict[str, Any]) -> None:
        """Args: the contents of `point_mass.toml`."""
        self.contents = contents

    @property
    def residuals(self) -> dict[str, Any]:
        """What the fit leaves, also on flights that it has not seen; units are in the keys."""
        return dict(self.contents["identification"])

    @property
    def shortcomings(self) -> list[str]:
        """A sentence for each figure that is not good enough to fly on."""
        from ftc_jsb.identify.judgement import shortcomings

        return shortcomings(self.contents["identification"])

    def save(self, path: str | PathLike[str], *, force: bool = False) -> Path:
        """Write `point_mass.toml`.

        Raises:
            WriteError: the file exists and `force` is not given, or it cannot be written.
        """
        from ftc_jsb.identify.point_mass_contents import write_point_mass

        where = Path(path)
        if where.exists() and not force:
            raise WriteError(where, "it exists; give another path, or force=True")
        write_point_mass(where, self.contents)
        return where

    def __repr__(self) -> str:
        """One line."""
        good = "; ".join(self.shortcomings) or "good enough to fly on"
        return f"<Identification of {self.contents.get('title', 'an aircraft')!r}: {good}>"


class Margins:
    """Gain, phase and delay that a loop bears in level flight, at each of its inputs."""

    def __init__(self, scenario: "schema.Scenario", channels: "Sequence[ChannelMargins]") -> None:
        """Args: level flight; what was measured at each input."""
        from ftc_jsb.margins.document import document

        self._scenario, self._channels = scenario, tuple(channels)
        self.document: dict[str, Any] = document(scenario, channels)

    def to_pandas(self) -> "pandas.DataFrame":
        """A row for each input; units are in the names of the columns."""
        import pandas

        rows = {
            channel: {key: value for key, value in entry.items() if key != "response"}
            for channel, entry in self.document["channels"].items()
        }
        return pandas.DataFrame(rows).T

    def plot(self) -> "Figure":
        """Bode diagrams with the margins found by inserting them."""
        from ftc_jsb.report.figures.bode import bode_figure

        return unshown(lambda: bode_figure(self._title(), self._channels))

    def _title(self) -> str:
        d = self.document
        where = f"{d['airspeed_mps']:g} m/s, {d['altitude_m']:g} m"
        return f"{d['aircraft']} ({d['model']}), loop {d['loop']}, {where}"

    def __repr__(self) -> str:
        """One line."""
        return f"<Margins of {self._title()}>"

    def _repr_html_(self) -> str:
        """For notebooks."""
        return str(self.to_pandas().to_html())


def identify(aircraft: str | PathLike[str], *, progress: bool | None = None) -> Identification:
    """Fit the point mass of an aircraft to virtual flight tests on JSBSim; takes minutes.

    Args:
        aircraft: a shipped one, or a folder with aircraft.toml and inner_loop.xml.
        progress: whether to show what is flown; by default on a terminal and in a notebook.

    Raises:
        AircraftError: it cannot be woven, trimmed or flown.
    """
    from ftc_jsb.aircraft.description import load_aircraft
    from ftc_jsb.identify.identification import identify as run
    from ftc_jsb.identify.identification import steps

    loaded = load_aircraft(fspath(aircraft))
    bar = Bar("Flight tests", steps(loaded), progress)
    try:
        return Identification(run(loaded, bar.step))
    finally:
        bar.close()


def margins(
    name: str | PathLike[str],
    *,
    model: str = "jsbsim",
    airspeed: float | None = None,
    altitude: float | None = None,
    progress: bool | None = None,
) -> Margins:
    """Measure gain, phase and delay margins in level flight; takes a minute.

    Args:
        name: a scenario, whose aircraft, loop, speed and altitude are taken; or an aircraft.
        model: what is flown.
        airspeed: [m/s], in place of that.
        altitude: [m].
        progress: whether to show what is flown; by default on a terminal and in a notebook.

    Raises:
        UserError: no such scenario or aircraft, or it does not fly.
    """
    from ftc_jsb.margins.condition import level_scenario
    from ftc_jsb.margins.measure import CHANNELS, STEPS, channel_margins

    flown = level_scenario(fspath(name), cast("schema.Model", model), airspeed, altitude)
    compiling()
    bar = Bar("Margins", STEPS * len(CHANNELS), progress)
    try:
        return Margins(flown, [channel_margins(flown, each, bar.step) for each in CHANNELS])
    finally:
        bar.close()
