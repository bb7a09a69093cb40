"""What a command does around flights: saving as it goes, checking, listing."""

import json
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from ftc_jsb.analysis.metrics import Metrics, flight_metrics
from ftc_jsb.errors import RecordingError
from ftc_jsb.recording.flight import Flight
from ftc_jsb.recording.netcdf import load, save
from ftc_jsb.runs.check import check_scenario
from ftc_jsb.scenario.schema import Model, Scenario
from ftc_jsb.simulation.command_source import CommandSource
from ftc_jsb.simulation.fly import Observer, fly

Flights = dict[str, Flight]
Watch = Callable[
    [str], AbstractContextManager[Sequence[Observer]]
]  # observers of a labelled flight


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
    watch: Watch,
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


def compare_and_save(scenario: Scenario, folder: Path, watch: Watch) -> tuple[Flights, bool]:
    """Fly every model with every loop of [compare], saving each flight as it is done.

    Returns:
        The flights by label, and whether the user stopped before the last was complete.
    """
    check_scenario(scenario)
    flights: Flights = {}
    for model in scenario.compare.models:
        for loop in scenario.compare.loops:
            try:
                with watch(f"{model}-{loop}") as observers:
                    flight = fly(variant(scenario, model, loop), observers)
                flights[flight.label] = flight
                save(flight, folder / f"{flight.label}.nc")
            except KeyboardInterrupt:
                if not flights:
                    raise
                return flights, True
            if flight.outcome.status == "interrupted":
                return flights, True
    return flights, False


def variant(scenario: Scenario, model: Model, loop: str) -> Scenario:
    """The same scenario for another model and loop."""
    named = scenario.loop.model_copy(update={"name": loop})
    return scenario.model_copy(update={"model": model, "loop": named})


def labelled_recordings(paths: Sequence[Path]) -> tuple[Flights, list[str]]:
    """Flights of recordings, labelled so that each is told apart; and what could not be read.

    Raises:
        RecordingError: none of them can be read.
    """
    loaded, broken = [], []
    for path in paths:
        try:
            loaded.append((path, load(path)))
        except RecordingError as error:
            broken.append(str(error))
    if not loaded:
        raise RecordingError("; ".join(broken))
    flights: Flights = {}
    for path, flight in loaded:
        label = flight.label
        if sum(other.label == label for _, other in loaded) > 1:
            label = f"{label} ({flight.scenario.name}, {path.parent.name or path.name})"
        flights[label if label not in flights else f"{label} [{len(flights)}]"] = flight
    return flights, broken


def document(metrics: dict[str, Metrics]) -> dict[str, Any]:
    """The contents of `metrics.json`."""
    return {"flights": metrics}


def write_metrics(path: Path, contents: dict[str, Any]) -> None:
    """Write `metrics.json`; unknown numbers are null, never NaN, which is no JSON.

    Raises:
        RecordingError: the file cannot be written.
    """
    try:
        text = json.dumps(contents, indent=2, allow_nan=False)
        path.write_text(text + "\n", encoding="utf-8")
    except OSError as error:
        raise RecordingError(f"{path}: cannot be written: {error.strerror}") from None
