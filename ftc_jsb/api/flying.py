"""`fly` and `load`: one flight."""

from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from ftc_jsb.api.announcement import compiling
from ftc_jsb.api.flight import Flight
from ftc_jsb.api.scenarios import LoopChoice, flown_scenario
from ftc_jsb.scenario import schema


def fly(
    scenario: "str | PathLike[str] | schema.Scenario" = "paper",
    *,
    model: str | None = None,
    loop: LoopChoice | None = None,
    set: Mapping[str, Any] | None = None,  # noqa: A002
) -> Flight:
    """Fly a scenario once; nothing is written.

    Args:
        scenario: name of a shipped one, path of a .toml file, or what `scenario` gave.
        model: `paper`, `identified` or `jsbsim`; the scenario's by default.
        loop: name of a loop, or a class of your own (docs/loops.md); the scenario's by default.
        set: values by dotted key, such as `{"fault[0].effectiveness": 0.5}`.

    Returns:
        The flight, complete or up to where it departed, failed or was interrupted.

    Raises:
        UserError: no such scenario, key, model, loop or trim; the message says what was expected.
    """
    from ftc_jsb.simulation.fly import fly as fly_scenario

    flown = flown_scenario(scenario, model, loop, set)
    compiling([flown])
    return Flight(fly_scenario(flown))


def load(path: str | PathLike[str]) -> Flight:
    """A flight out of its recording.

    Raises:
        RecordingError: no such file, not a recording of this program, or damaged.
    """
    from ftc_jsb.recording.netcdf import load as read

    return Flight(read(Path(path)))
