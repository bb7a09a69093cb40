"""Commands in flight as data: what may change a flight, and how a recording keeps it.

The same commands at the same rows make the same flight, bit for bit.
"""

import json
from collections.abc import Sequence
from typing import Annotated, Literal, NamedTuple

from pydantic import Field, TypeAdapter

from ftc_jsb.scenario.faults import Fault
from ftc_jsb.typed_file import Section

_Key = Annotated[str, Field(min_length=1, max_length=80)]


class SetAirspeed(Section):
    """Airspeed command to `value`, at `rate`."""

    kind: Literal["set-airspeed"] = "set-airspeed"
    value: float = Field(ge=50.0, le=600.0)  # m/s
    rate: float = Field(ge=1e-9, le=100.0)  # m/s^2


class SetFlightPath(Section):
    """Flight path command to `value`, at `rate`."""

    kind: Literal["set-flight-path"] = "set-flight-path"
    value: float = Field(ge=-1.05, le=1.05)  # rad: 60 deg, as in [reference]
    rate: float = Field(ge=1e-9, le=1.0)  # rad/s


class SetHeading(Section):
    """Heading command to `value`, the shorter way round, at `rate`."""

    kind: Literal["set-heading"] = "set-heading"
    value: float = Field(ge=-6.3, le=6.3)  # rad: one turn either way
    rate: float = Field(ge=1e-9, le=1.0)  # rad/s


class SetAltitude(Section):
    """Climb or descend to `value` and hold it, until a flight path is commanded."""

    kind: Literal["set-altitude"] = "set-altitude"
    value: float = Field(ge=0.0, le=20000.0)  # m
    flight_path: float = Field(ge=1e-9, le=1.05)  # rad, the steepest
    rate: float = Field(ge=1e-9, le=1.0)  # rad/s, of the flight path


class SetFaults(Section):
    """Every fault of `targets` ends, and `faults` begin."""

    kind: Literal["set-faults"] = "set-faults"
    targets: Annotated[tuple[_Key, ...], Field(min_length=1, max_length=32)]
    faults: Annotated[tuple[Fault, ...], Field(max_length=16)] = ()  # their `start` is now


class SetLoop(Section):
    """A number of [loop], such as `gains[0]` or `detector.margin`."""

    kind: Literal["set-loop"] = "set-loop"
    key: _Key
    value: float


class ChangeScenario(Section):
    """References, faults or numbers of the loop are as the scenario with these overrides has them."""

    kind: Literal["change-scenario"] = "change-scenario"
    overrides: Annotated[
        tuple[Annotated[str, Field(max_length=100_000)], ...], Field(max_length=1000)
    ] = ()  # key=value


class Pause(Section):
    """Time stands still; the flight is not changed."""

    kind: Literal["pause"] = "pause"


class Resume(Section):
    """Time goes on."""

    kind: Literal["resume"] = "resume"


class End(Section):
    """The flight ends here."""

    kind: Literal["end"] = "end"


class Reset(Section):
    """The flight ends here, and the scenario is flown again from its start."""

    kind: Literal["reset"] = "reset"


Command = (
    SetAirspeed
    | SetFlightPath
    | SetHeading
    | SetAltitude
    | SetFaults
    | SetLoop
    | ChangeScenario
    | Pause
    | Resume
    | End
    | Reset
)


class Applied(NamedTuple):
    """A command and the row before which it was applied."""

    row: int
    command: Command


class _Entry(Section):
    """`Applied` in a recording."""

    row: int = Field(ge=1)
    command: Annotated[Command, Field(discriminator="kind")]


_ENTRIES = TypeAdapter(tuple[_Entry, ...])


def commands_json(applied: Sequence[Applied]) -> str:
    """Applied commands as JSON: what a recording carries."""
    return json.dumps(
        [{"row": row, "command": command.model_dump(mode="json")} for row, command in applied]
    )


def parse_commands(text: str) -> tuple[Applied, ...]:
    """The inverse of `commands_json`.

    Raises:
        pydantic.ValidationError: not such a list.
    """
    entries = _ENTRIES.validate_json(text, strict=True)
    return tuple(Applied(entry.row, entry.command) for entry in entries)
