"""The schema of a recording, checked before it is believed: attributes, sizes, rows, digests.

A file that opens may have been cut, edited, written by another program or made up. What passes here has
the columns of a flight of its own scenario, as many rows as that can have at most, and time that runs
as it does in one.
"""

from collections.abc import Mapping
from typing import Annotated, Any, Literal, Protocol

import numpy as np
import numpy.typing as npt
from pydantic import BaseModel, ConfigDict, Field, Json, ValidationError

from ftc_jsb.errors import RecordingError, ScenarioError
from ftc_jsb.recording.columns import ROW
from ftc_jsb.recording.commands import Applied, parse_commands
from ftc_jsb.recording.integrity import ADDED, DATA, DESCRIPTION, data_digest, description_digest
from ftc_jsb.scenario.load import parse_scenario
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.typed_file import Section, first_problem

_LONG = 16_000_000  # characters of the scenario, or of the commands: 10,000 breakpoints thrice are 1 million
_CHUNK = 2**27  # values that the library unpacks at once, 1 GB
_LATE = 1e-6  # of a row's time after the rows' period, in periods: rounding


class Attributes(BaseModel):
    """What every recording says of itself."""

    model_config = ConfigDict(frozen=True, allow_inf_nan=False, strict=True)

    scenario: Annotated[str, Field(max_length=_LONG)]
    status: Literal["complete", "ended", "departed", "failed", "interrupted"]
    end_time_s: Annotated[float, Field(ge=0.0)]
    reason: Annotated[str, Field(max_length=100_000)]
    commands: Annotated[str, Field(max_length=_LONG)] = "[]"
    versions: Json[dict[str, str]] = {}  # of an older one
    machine: Annotated[str, Field(max_length=1000)] = "machine not recorded"
    aircraft_digest: Annotated[str, Field(max_length=1000)] = ""


class _Variable(Protocol):
    """A variable of a NetCDF file."""

    dtype: Any
    dimensions: tuple[str, ...]

    def chunking(self) -> Any:
        """Values that are stored as one along each dimension, or "contiguous"."""


def checked_attributes(found: Mapping[str, Any], source: str) -> Attributes:
    """The attributes of a recording.

    Args:
        found: attributes of the file.
        source: names the file in messages.

    Raises:
        RecordingError: not those of a recording, or not those that were written.
    """
    plain = {name: _plain(value) for name, value in found.items()}
    if DESCRIPTION in plain:
        said = {name: plain[name] for name in plain if name not in (DESCRIPTION, *ADDED)}
        if any(isinstance(value, list) for value in said.values()) or (
            description_digest(said) != plain[DESCRIPTION]
        ):
            raise RecordingError(
                f"{source}: damaged, or changed by another program: its attributes are not those that "
                "were written"
            )
    missing = [name for name in Attributes.model_fields if name not in plain]
    needed = [name for name in missing if Attributes.model_fields[name].is_required()]
    if needed:
        raise RecordingError(f"{source}: not a recording of this program: it has no {needed[0]!r}")
    try:
        return Attributes.model_validate(plain)
    except ValidationError as error:
        raise RecordingError(f"{source}: attribute {first_problem(error, Attributes)}") from None


def checked_scenario(attributes: Attributes, source: str) -> Scenario:
    """The scenario inside a recording, which its outcome suits.

    Raises:
        RecordingError: not one.
    """
    try:
        scenario = parse_scenario(attributes.scenario, source)
    except ScenarioError as error:
        raise RecordingError(f"{error} (the scenario inside the recording)") from None
    latest = scenario.duration + 1.0 / scenario.loop.rate
    if attributes.end_time_s > latest:
        raise RecordingError(
            f"{source}: attribute end_time_s: {attributes.end_time_s:g} s; expected 0 to "
            f"{scenario.duration:g}, the scenario's duration"
        )
    return scenario


def checked_commands(
    attributes: Attributes, scenario: Scenario, source: str
) -> tuple[Applied, ...]:
    """The commands of a recording, in the order of their rows.

    Raises:
        RecordingError: not such commands.
    """
    try:
        commands = parse_commands(attributes.commands)
    except ValidationError as error:
        raise RecordingError(f"{source}: commands: {first_problem(error, Section)}") from None
    rows = [command.row for command in commands]
    if rows != sorted(rows) or any(row > scenario.samples for row in rows):
        raise RecordingError(
            f"{source}: commands: their rows must increase, up to {scenario.samples}"
        )
    return commands


def checked_sizes(
    dimensions: Mapping[str, int],
    variables: Mapping[str, _Variable],
    scenario: Scenario,
    source: str,
) -> int:
    """Rows of a recording, from what its file says before any of them is read.

    Args:
        dimensions: sizes by name.
        variables: by name.
        scenario: that was flown.
        source: names the file in messages.

    Raises:
        RecordingError: a column is missing or no column of numbers, or there are no rows, or more than
            the scenario has.
    """
    for name in ROW.names or ():
        if name not in variables:
            raise RecordingError(f"{source}: not a recording of this program: it has no {name!r}")
        variable = variables[name]
        if variable.dimensions != ("time",) or variable.dtype != np.dtype(float):
            raise RecordingError(
                f"{source}: variable {name!r}: expected numbers of 64 bits along 'time' "
                f"(got {variable.dtype} along {', '.join(variable.dimensions) or 'nothing'})"
            )
        chunks = variable.chunking()
        if chunks != "contiguous" and max(chunks) > _CHUNK:
            raise RecordingError(f"{source}: variable {name!r}: stored in pieces of {max(chunks)}")
    rows, most = dimensions["time"], scenario.samples // scenario.simulation.record_every + 1
    if not 1 <= rows <= most:
        raise RecordingError(
            f"{source}: {rows} rows; expected 1 to {most} of this scenario, {scenario.duration:g} s "
            f"at {scenario.loop.rate:g} Hz"
        )
    return rows


def check_rows(
    record: npt.NDArray[Any], found: Mapping[str, Any], scenario: Scenario, source: str
) -> None:
    """See that rows are those that were written, and time runs as in a flight.

    Args:
        record: (rows,) of `columns.ROW`.
        found: attributes of the file.
        scenario: that was flown.
        source: names the file in messages.

    Raises:
        RecordingError: they are not.
    """
    if found.get(DATA, "") not in ("", data_digest(record)):
        raise RecordingError(
            f"{source}: damaged, or changed by another program: its rows are not those that were written"
        )
    period = scenario.simulation.record_every / scenario.loop.rate
    late = np.abs(record["time"] / period - np.arange(record.size))
    wrong = np.flatnonzero(~(late <= _LATE * np.maximum(1.0, np.arange(record.size))))
    if wrong.size:
        row = int(wrong[0])
        raise RecordingError(
            f"{source}: row {row}: time is {record['time'][row]:g} s; expected {row * period:g}"
        )


def _plain(value: Any) -> Any:
    """An attribute as Python has it: NumPy's numbers are numbers, its arrays lists."""
    return value.tolist() if isinstance(value, np.ndarray | np.generic) else value
