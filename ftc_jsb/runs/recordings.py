"""Recordings that are there already, read and labelled."""

from collections.abc import Sequence
from pathlib import Path

from ftc_jsb.errors import RecordingError
from ftc_jsb.recording.flight import Flight
from ftc_jsb.recording.netcdf import load


def labelled_recordings(paths: Sequence[Path]) -> tuple[dict[str, Flight], list[str]]:
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
    flights: dict[str, Flight] = {}
    for path, flight in loaded:
        label = flight.label
        if sum(other.label == label for _, other in loaded) > 1:
            label = f"{label} ({flight.scenario.name}, {path.parent.name or path.name})"
        flights[label if label not in flights else f"{label} [{len(flights)}]"] = flight
    return flights, broken
