"""One flight, saved with its metrics as soon as it is over."""

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from ftc_jsb.analysis.metrics import Metrics, flight_metrics
from ftc_jsb.recording.flight import Flight
from ftc_jsb.recording.netcdf import save
from ftc_jsb.runs.metrics_file import document, write_metrics
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.command_source import CommandSource
from ftc_jsb.simulation.fly import Observer, fly

# Label of a flight -> its observers, for as long as it is flown
ObserverFactory = Callable[[str], AbstractContextManager[Sequence[Observer]]]


class Result(NamedTuple):
    """A flight that was flown and saved."""

    label: str
    metrics: Metrics
    document: dict[str, Any]


class Live(Protocol):
    """Real time and ground stations, as a flight sees them."""

    observers: Sequence[Observer]
    commands: CommandSource | None

    def flies_again(self, flight: Flight) -> bool:
        """A flight is over and saved; whether another of the same scenario is wanted."""


def fly_and_save(
    scenario: Scenario,
    folder: Path,
    watch: ObserverFactory,
    live: Live | None = None,
    output: Path | None = None,
) -> Result:
    """Fly; write `flight.nc` and `metrics.json`, also of a flight that did not end well.

    A live flight may be flown again; the earlier ones are then `flight-1.nc`, `flight-2.nc`, ...

    Args:
        scenario: as loaded.
        folder: exists.
        watch: gives the observers.
        live: real time and ground stations.
        output: JSBSim's output directive.
    """
    path = folder / "flight.nc"
    flown = 0
    while True:
        with watch(scenario.model) as observers:
            if live is None:
                flight = fly(scenario, observers, output=output)
            else:
                beside = (*observers, *live.observers)
                flight = fly(scenario, beside, commands=live.commands, output=output)
        if flown:
            path.replace(folder / f"flight-{flown}.nc")
        save(flight, path)
        flown += 1
        if live is None or not live.flies_again(flight):
            break
    metrics = flight_metrics(flight)
    contents = document({flight.label: metrics})
    write_metrics(folder / "metrics.json", contents)
    return Result(flight.label, metrics, contents)
