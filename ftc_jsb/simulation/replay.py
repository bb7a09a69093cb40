"""A recorded flight flown again, its commands included, and compared bit for bit."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ftc_jsb.recording.columns import ROW
from ftc_jsb.recording.commands import Applied, End, Reset
from ftc_jsb.recording.flight import Flight
from ftc_jsb.recording.provenance import Provenance, aircraft_digest, versions
from ftc_jsb.simulation.command_source import RecordedCommands
from ftc_jsb.simulation.fly import Observer, fly


class Difference(NamedTuple):
    """A variable in which two recordings differ."""

    name: str
    time: float  # [s], of the first sample that differs
    largest: float  # magnitude, in the variable's unit


def replay(flight: Flight, observers: Sequence[Observer] = ()) -> Flight:
    """Fly the scenario of `flight` again with its commands, up to where it stopped.

    Raises:
        UserError: as `fly`.
    """
    commands = list(flight.commands)
    cut = flight.outcome.status in ("ended", "interrupted")
    if cut and not (commands and isinstance(commands[-1].command, End | Reset)):
        row = round(flight.outcome.time * flight.scenario.loop.rate)
        commands.append(Applied(max(row, 1), End()))  # where Ctrl-C came
    return fly(flight.scenario, observers, commands=RecordedCommands(commands))


def differences(flight: Flight, again: Flight) -> list[Difference]:
    """Variables that are not the same to the bit (nan is the same as nan), the earliest first."""
    one, other = flight.record, again.record[:: flight.scenario.simulation.record_every]
    rows = min(one.size, other.size)
    found = []
    for name in ROW.names or ():
        a, b = one[name][:rows], other[name][:rows]
        unequal = np.flatnonzero(~((a == b) | (np.isnan(a) & np.isnan(b))))
        if unequal.size:
            largest = float(np.nanmax(np.abs(a - b), initial=0.0))
            found.append(Difference(name, float(one["time"][unequal[0]]), largest))
        elif one.size != other.size:
            found.append(Difference(name, float(max(one, other, key=len)["time"][rows]), np.nan))
    return sorted(found, key=lambda difference: difference.time)


def changed_since(flight: Flight) -> list[str]:
    """What is not as it was when `flight` was recorded: versions, and the aircraft's own files.

    Args:
        flight: that was read back.
    """
    made = flight.provenance or Provenance({}, "")
    now = versions()
    changes = [
        f"{name} {before}, now {now.get(name)}"
        for name, before in made.versions.items()
        if before != now.get(name)
    ]
    if made.aircraft_digest != aircraft_digest(flight.scenario):
        changes.append("the files of the aircraft have changed")
    return changes
