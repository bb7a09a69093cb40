"""A flight as a NetCDF file that holds all it takes to fly it again."""

import json
from pathlib import Path
from typing import Any, cast

import numpy as np
from pydantic import ValidationError

from ftc_jsb.atomic_file import atomic_file
from ftc_jsb.errors import RecordingError, ScenarioError, WriteError
from ftc_jsb.interruption import uninterrupted
from ftc_jsb.recording.columns import ROW, VARIABLES
from ftc_jsb.recording.commands import parse_commands
from ftc_jsb.recording.description import attributes
from ftc_jsb.recording.flight import Flight, Outcome
from ftc_jsb.recording.provenance import Provenance
from ftc_jsb.scenario.load import parse_scenario
from ftc_jsb.typed_file import Section, first_problem

COMPRESSION: dict[str, Any] = {"zlib": True, "complevel": 1}


def save(flight: Flight, path: Path) -> None:
    """Write a flight as NetCDF 4; a broken write leaves no recording.

    Raises:
        WriteError: the file cannot be written.
    """
    with uninterrupted(), atomic_file(path) as part:
        try:
            _write(flight, part)
        except RuntimeError as error:  # what the HDF library makes of a full disk
            raise WriteError(path, f"{error}; the disk may be full") from None


def _write(flight: Flight, path: Path) -> None:
    """By netCDF4 itself: xarray, which reads it as any other, takes longer to import than a flight."""
    import netCDF4

    with netCDF4.Dataset(path, "w") as file:
        file.setncatts(attributes(flight))
        record = flight.record[:: flight.scenario.simulation.record_every]
        file.createDimension("time", record.size)
        for name, unit, meaning in VARIABLES:
            column = file.createVariable(name, float, "time", fill_value=np.nan, **COMPRESSION)
            column.setncatts({"units": unit, "long_name": meaning})
            column[:] = record[name]


def attributes_of(path: Path) -> dict[str, Any]:
    """Attributes of a recording that `load` has read."""
    import xarray

    with xarray.open_dataset(path, engine="netcdf4", decode_times=False) as dataset:
        return dict(dataset.attrs)


def load(path: Path) -> Flight:
    """Read a flight back.

    Raises:
        RecordingError: not a recording of this program, or damaged.
    """
    import netCDF4

    if not path.is_file():
        raise RecordingError(f"{path}: no such file; expected a recording (flight.nc)")
    try:
        with netCDF4.Dataset(path) as file:
            file.set_auto_mask(False)
            found = {name: file.getncattr(name) for name in file.ncattrs()}
            columns = {name: variable[:] for name, variable in file.variables.items()}
    except (OSError, RuntimeError, ValueError) as error:
        raise RecordingError(f"{path}: not a readable NetCDF file: {error}") from None
    missing = [key for key in ("scenario", "status", "end_time_s", "reason") if key not in found]
    missing += [name for name in ROW.names or () if name not in columns]
    if missing:
        raise RecordingError(f"{path}: not a recording of this program: it has no {missing[0]!r}")
    try:
        scenario = parse_scenario(str(found["scenario"]), str(path))
    except ScenarioError as error:
        raise RecordingError(f"{error} (the scenario inside the recording)") from None
    record = np.zeros(columns["time"].size, ROW)
    for name in ROW.names or ():
        record[name] = columns[name]
    try:
        commands = parse_commands(str(found.get("commands", "[]")))
    except ValidationError as error:
        raise RecordingError(f"{path}: commands: {first_problem(error, Section)}") from None
    status = cast(Any, found["status"])
    outcome = Outcome(status, float(found["end_time_s"]), str(found["reason"]))
    return Flight(scenario, record, outcome, None, commands, _provenance(found))


def _provenance(attributes: dict[Any, Any]) -> Provenance:
    """As the recording says; an older one does not name the machine."""
    try:
        found = {str(k): str(v) for k, v in json.loads(str(attributes["versions"])).items()}
    except (KeyError, ValueError, AttributeError):
        found = {}
    return Provenance(found, str(attributes.get("machine", "machine not recorded")))
