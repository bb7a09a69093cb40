"""What a command does around flights: saving as it goes, checking, listing."""

import json
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any, NamedTuple

from ftc_jsb.control.loops import BUILT_IN, loop_names, make_loop
from ftc_jsb.control.protocol import LoopSetup
from ftc_jsb.errors import RecordingError, UserError
from ftc_jsb.metrics import Metrics, flight_metrics
from ftc_jsb.scenario.load import load_scenario, scenario_names
from ftc_jsb.scenario.schema import Model, Scenario
from ftc_jsb.simulation.flight import Flight
from ftc_jsb.simulation.fly import Observer, fly, point_mass_of, refuse_unflyable
from ftc_jsb.simulation.recording import load, save
from ftc_jsb.six_dof.aircraft import PAPER_AIRCRAFT, aircraft_folder, aircraft_names, load_aircraft

Flights = dict[str, Flight]
Watch = Callable[
    [str], AbstractContextManager[Sequence[Observer]]
]  # observers of a labelled flight


class Result(NamedTuple):
    """A flight that was flown and saved."""

    label: str
    metrics: Metrics
    document: dict[str, Any]


def fly_and_save(scenario: Scenario, folder: Path, watch: Watch) -> Result:
    """Fly once; write `flight.nc` and `metrics.json`, also of a flight that did not end well."""
    with watch(scenario.model) as observers:
        flight = fly(scenario, observers)
    save(flight, folder / "flight.nc")
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


def check_scenario(scenario: Scenario) -> list[str]:
    """See that the aircraft and loops of a scenario exist; a line for each thing found good.

    Raises:
        UserError: one of them does not.
    """
    lines = [f"scenario {scenario.name!r}: {scenario.duration:g} s, {scenario.samples} samples"]
    models = dict.fromkeys((scenario.model, *scenario.compare.models))
    for model in models:
        point_mass_of(scenario.model_copy(update={"model": model}))
        refuse_unflyable(scenario.model_copy(update={"model": model}))
        if model == "jsbsim":
            lines.append(f"model {model}: {_trimmed(scenario)}, woven, loaded and trimmed")
        else:
            name = PAPER_AIRCRAFT if model == "paper" else scenario.aircraft.name
            lines.append(f"model {model}: point mass of {aircraft_folder(name).name}")
    for loop in dict.fromkeys((scenario.loop.name, *scenario.compare.loops)):
        named = scenario.loop.model_copy(update={"name": loop})
        fly_ready = scenario.model_copy(update={"loop": named})
        aircraft = point_mass_of(fly_ready)
        mass = aircraft.initial_mass(scenario.aircraft.fuel_fraction)
        if loop not in BUILT_IN:
            make_loop(LoopSetup(aircraft, mass, named, 1.0 / named.rate))
        lines.append(f"loop {loop}: found and built")
    return lines


def _trimmed(scenario: Scenario) -> str:
    """Weave, load and trim the aircraft of a scenario; its title."""
    from ftc_jsb.six_dof.trim import trimmed
    from ftc_jsb.six_dof.weaving import woven_aircraft

    aircraft = load_aircraft(scenario.aircraft.name)
    root = woven_aircraft(aircraft, scenario.aircraft.flight_control == "corrected")
    dt = 1.0 / (scenario.loop.rate * scenario.simulation.jsbsim_steps)
    trimmed(aircraft, root, dt, scenario.initial, scenario.aircraft.fuel_fraction)
    return aircraft.title


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
