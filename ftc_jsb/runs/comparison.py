"""Every model with every loop of [compare], flown and saved one after the other."""

from pathlib import Path

from ftc_jsb.interruption import uninterrupted
from ftc_jsb.recording.flight import Flight
from ftc_jsb.runs.check import check_scenario
from ftc_jsb.runs.observers import ObserverFactory
from ftc_jsb.runs.rescue import save_or_rescue
from ftc_jsb.scenario.schema import Model, Scenario
from ftc_jsb.simulation.fly import fly


def compare_and_save(
    scenario: Scenario, folder: Path, observers_for: ObserverFactory
) -> tuple[dict[str, Flight], bool]:
    """Fly every model with every loop of [compare], saving each flight as it is done.

    Args:
        scenario: as loaded.
        folder: exists; gets `<model>-<loop>.nc`.
        observers_for: gives the observers of a flight by its label.

    Returns:
        The flights by label, and whether the user stopped before the last was complete.

    Raises:
        UserError: as `check_scenario` and `fly`; or the folder cannot be written.
    """
    folder = folder.absolute()
    check_scenario(scenario)
    flights: dict[str, Flight] = {}
    for model in scenario.compare.models:
        for loop in scenario.compare.loops:
            try:
                with uninterrupted():  # but for the flight itself
                    with observers_for(f"{model}-{loop}") as observers:
                        flight = fly(variant(scenario, model, loop), observers)
                    flights[flight.label] = flight
                    save_or_rescue(flight, folder / f"{flight.label}.nc")
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
