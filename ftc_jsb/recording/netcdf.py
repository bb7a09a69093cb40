"""A flight as a NetCDF file that holds all it takes to fly it again."""

from pathlib import Path
from typing import Any

import numpy as np

from ftc_jsb.atomic_file import atomic_file
from ftc_jsb.bounded_file import is_file
from ftc_jsb.errors import RecordingError, WriteError
from ftc_jsb.interruption import uninterrupted
from ftc_jsb.recording.checked import (
    check_rows,
    checked_attributes,
    checked_commands,
    checked_scenario,
    checked_sizes,
)
from ftc_jsb.recording.columns import ROW, VARIABLES
from ftc_jsb.recording.description import attributes
from ftc_jsb.recording.flight import Flight, Outcome
from ftc_jsb.recording.integrity import sealed
from ftc_jsb.recording.provenance import Provenance

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
        record = flight.record[:: flight.scenario.simulation.record_every]
        file.setncatts(sealed(attributes(flight), record))
        file.createDimension("time", record.size)
        for name, unit, meaning in VARIABLES:
            column = file.createVariable(name, float, "time", fill_value=np.nan, **COMPRESSION)
            column.setncatts({"units": unit, "long_name": meaning})
            column[:] = record[name]


def load(path: Path) -> Flight:
    """Read a flight back.

    Raises:
        RecordingError: not a recording of this program, damaged, or larger than a flight of its scenario.
    """
    if not is_file(path):
        raise RecordingError(f"{path}: no such file; expected a recording (flight.nc)")
    try:
        return _read(path)
    except RecordingError:
        raise
    except MemoryError:
        raise RecordingError(f"{path}: there is not enough memory to read it") from None
    except Exception as error:  # whatever the library makes of a file that is none
        reason = getattr(error, "strerror", None) or str(error) or type(error).__name__
        reason = reason.splitlines()[0]
        raise RecordingError(f"{path}: not a readable NetCDF file: {reason}") from None


def _read(path: Path) -> Flight:
    """What the file says is checked before it is believed, sizes before anything of that size is read."""
    import netCDF4

    source = str(path)
    with netCDF4.Dataset(path) as file:
        file.set_auto_maskandscale(False)
        found = {name: file.getncattr(name) for name in file.ncattrs()}
        attributes = checked_attributes(found, source)
        scenario = checked_scenario(attributes, source)
        commands = checked_commands(attributes, scenario, source)
        sizes = {name: dimension.size for name, dimension in file.dimensions.items()}
        record = np.empty(
            checked_sizes(sizes, dict[str, Any](file.variables), scenario, source), ROW
        )
        for name in ROW.names or ():
            record[name] = file.variables[name][:]
    check_rows(record, found, scenario, source)
    outcome = Outcome(attributes.status, attributes.end_time_s, attributes.reason)
    provenance = Provenance(attributes.versions, attributes.machine, attributes.aircraft_digest)
    return Flight(scenario, record, outcome, None, commands, provenance)
