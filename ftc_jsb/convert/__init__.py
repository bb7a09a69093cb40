"""Recordings in the formats of other programs, one module a format.

A format is a row of `FORMATS` and a module `ftc_jsb.convert.<name>` with
`write(flight: Flight, path: Path) -> None`, imported when it is asked for.
"""

import importlib
from pathlib import Path
from typing import NamedTuple

from ftc_jsb.errors import RecordingError
from ftc_jsb.recording.flight import Flight


class Format(NamedTuple):
    """A format that a recording can be converted to."""

    suffix: str  # of the file, dot included
    meaning: str


FORMATS: dict[str, Format] = {
    "acmi": Format(".acmi", "TacView 2.2"),
    "csv": Format(".csv", "comma-separated text, units in the header: any spreadsheet"),
    "mat": Format(".mat", "MATLAB 5: loadmat, Octave"),
    "parquet": Format(".parquet", "Apache Parquet, units in the schema: pandas, Polars, DuckDB"),
    "tlog": Format(".tlog", "MAVLink telemetry log: mavlogdump, MAVExplorer, Mission Planner"),
}


def convert(flight: Flight, name: str, path: Path) -> None:
    """Write `flight` to `path` in the format `name`, by way of a temporary name.

    Raises:
        RecordingError: the file cannot be written.
    """
    part = path.with_name(path.name + ".part")
    try:
        importlib.import_module(f"{__name__}.{name}").write(flight, part)
        part.replace(path)
    except OSError as error:
        raise RecordingError(f"{path}: cannot be written: {error.strerror or error}") from None
    finally:
        part.unlink(missing_ok=True)
