"""What a command does around flights: output folders, saving as it goes, checking, listing."""

import json
from collections.abc import Callable, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any, NamedTuple

from ftc_jsb.control.loops import BUILT_IN, find_loop, loop_names
from ftc_jsb.errors import RecordingError, UserError
from ftc_jsb.metrics import Metrics, flight_metrics
from ftc_jsb.scenario.load import load_scenario, scenario_names
from ftc_jsb.scenario.schema import Model, Scenario
from ftc_jsb.simulation.flight import Flight
from ftc_jsb.simulation.fly import PAPER_AIRCRAFT, Observer, fly, point_mass_of
from ftc_jsb.simulation.recording import load, save
from ftc_jsb.six_dof.aircraft import aircraft_folder, aircraft_names, load_aircraft

Flights = dict[str, Flight]
Watch = Callable[[str], Sequence[Observer]]  # the observers of a flight with this label


class Result(NamedTuple):
    """A flight that was flown and saved."""

    label: str
    metrics: Metrics
    document: dict[str, Any]


def output_folder(out: Path | None, name: str, force: bool) -> Path:
    """Make the folder for results and see that it can be written, before anything is flown.

    Args:
        out: as given, or None for ./out/<name>-<date-time>.
        name: of the default folder.
        force: accept a folder that is not empty.

    Raises:
        RecordingError: the folder is not empty, or cannot be made or written.
    """
    folder = out or Path("out") / f"{name}-{datetime.now():%Y%m%d-%H%M%S}"
    try:
        if folder.exists() and not folder.is_dir():
            raise RecordingError(f"--out {folder}: is a file; expected a folder")
        if folder.is_dir() and any(folder.iterdir()) and not force:
            raise RecordingError(f"--out {folder}: is not empty; give another folder, or --force")
        folder.mkdir(parents=True, exist_ok=True)
        probe = folder / ".ftc-jsb-write-test"
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise RecordingError(f"--out {folder}: cannot be written: {error.strerror}") from None
    return folder


def fly_and_save(scenario: Scenario, folder: Path, watch: Watch) -> Result:
    """Fly once; write `flight.nc` and `metrics.json`, also of a flight that did not end well."""
    flight = fly(scenario, watch(scenario.model))
    save(flight, folder / "flight.nc")
    metrics = flight_metrics(flight)
    contents = document({flight.label: metrics})
    _write_json(folder / "metrics.json", contents)
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
            flight = fly(variant(scenario, model, loop), watch(f"{model}-{loop}"))
            flights[flight.label] = flight
            save(flight, folder / f"{flight.label}.nc")
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


def check_scenario(scenario: Scenario) -> list[str]:
    """See that the aircraft and loops of a scenario exist; a line for each thing found good.

    Raises:
        UserError: one of them does not.
    """
    lines = [f"scenario {scenario.name!r}: {scenario.duration:g} s, {scenario.samples} samples"]
    models = dict.fromkeys((scenario.model, *scenario.compare.models))
    for model in models:
        point_mass_of(scenario.model_copy(update={"model": model}))
        if model == "jsbsim":
            aircraft = load_aircraft(scenario.aircraft.name)
            lines.append(f"model {model}: {aircraft.title}")
        else:
            name = PAPER_AIRCRAFT if model == "paper" else scenario.aircraft.name
            lines.append(f"model {model}: point mass of {aircraft_folder(name).name}")
    for loop in dict.fromkeys((scenario.loop.name, *scenario.compare.loops)):
        if loop not in BUILT_IN:
            find_loop(loop)
        lines.append(f"loop {loop}: found")
    return lines


def inventory() -> dict[str, dict[str, str]]:
    """Names and meanings of what is shipped or installed."""
    aircraft = {}
    for name in aircraft_names():
        aircraft[name] = point_mass_title(name)
    return {
        "scenarios": {name: load_scenario(name).title for name in scenario_names()},
        "aircraft": aircraft,
        "loops": loop_names(),
    }


def point_mass_title(name: str) -> str:
    """Title of a shipped aircraft's point mass."""
    from ftc_jsb.point_mass.parameters import load_point_mass

    try:
        return load_point_mass(aircraft_folder(name)).title
    except UserError as error:
        return str(error)


def document(metrics: dict[str, Metrics]) -> dict[str, Any]:
    """The contents of `metrics.json`."""
    return {"flights": metrics}


def _write_json(path: Path, contents: dict[str, Any]) -> None:
    try:
        path.write_text(json.dumps(contents, indent=2) + "\n", encoding="utf-8")
    except OSError as error:
        raise RecordingError(f"{path}: cannot be written: {error.strerror}") from None
