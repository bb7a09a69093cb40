"""Recordings that are there already, read and labelled."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from ftc_jsb.errors import RecordingError
from ftc_jsb.recording.flight import Flight
from ftc_jsb.recording.netcdf import load


class Recordings(NamedTuple):
    """Flights by label, their files likewise, and what is wrong with files that could not be read."""

    flights: dict[str, Flight]
    broken: list[str]
    files: dict[str, Path]


def labelled_recordings(paths: Sequence[Path]) -> Recordings:
    """Flights of recordings, labelled so that each is told apart.

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
    files: dict[str, Path] = {}
    for path, flight in loaded:
        label = flight.label
        if sum(other.label == label for _, other in loaded) > 1:
            label = f"{label} ({flight.scenario.name}, {path.parent.name or path.name})"
        label = label if label not in flights else f"{label} [{len(flights)}]"
        flights[label], files[label] = flight, path
    return Recordings(flights, broken, files)
