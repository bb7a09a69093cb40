"""One flight, flown and saved."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ftc_jsb.analysis.metrics import Metrics, flight_metrics
from ftc_jsb.interruption import uninterrupted
from ftc_jsb.recording.flight import Flight
from ftc_jsb.runs.live import Live
from ftc_jsb.runs.metrics_file import document, write_metrics
from ftc_jsb.runs.observers import ObserverFactory
from ftc_jsb.runs.rescue import save_or_rescue
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.fly import fly


class Result(NamedTuple):
    """A flight that was flown and saved."""

    label: str
    metrics: Metrics
    document: dict[str, Any]  # the contents of metrics.json


def fly_and_save(
    scenario: Scenario,
    folder: Path,
    observers_for: ObserverFactory,
    live: Live | None = None,
    flown_by: Callable[..., Flight] = fly,
) -> Result:
    """Fly; write `flight.nc` and `metrics.json`, also of a flight that did not end well.

    A live flight may be flown again; the earlier ones are then `flight-1.nc`, `flight-2.nc`, ...

    Args:
        scenario: as loaded.
        folder: exists.
        observers_for: gives the observers.
        live: real time and ground stations.
        flown_by: in place of `fly`, with its arguments.

    Raises:
        UserError: as `fly`; or the folder cannot be written.
    """
    folder = folder.absolute()
    path = folder / "flight.nc"
    flown = 0
    with uninterrupted():  # but for the flight itself, and the wait after it
        while True:
            with observers_for(scenario.model) as observers:
                if live is None:
                    flight = flown_by(scenario, observers)
                else:
                    beside = (*observers, *live.observers)
                    flight = flown_by(scenario, beside, commands=live.commands)
            if flown:
                path.replace(folder / f"flight-{flown}.nc")
            save_or_rescue(flight, path)
            flown += 1
            if live is None or not live.flies_again(flight):
                break
        with np.errstate(all="ignore"):  # what overflows is null
            contents = document({flight.label: flight_metrics(flight)})
        write_metrics(folder / "metrics.json", contents)
    return Result(flight.label, contents["flights"][flight.label], contents)
