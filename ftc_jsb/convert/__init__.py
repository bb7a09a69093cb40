"""Recordings in the formats of other programs, one module a format.

A format is a row of `FORMATS` and a module `ftc_jsb.convert.<name>` with
`write(flight: Flight, path: Path) -> None`, imported when it is asked for.
"""

import importlib
from pathlib import Path
from typing import NamedTuple

from ftc_jsb.atomic_file import atomic_file
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


def convert(flight: Flight, name: str, path: Path, *, replace: bool = False) -> None:
    """Write `flight` to `path` in the format `name`, whole or not at all.

    Args:
        flight: to be written.
        name: one of FORMATS.
        path: of the new file.
        replace: whether a file that is there already is replaced.

    Raises:
        WriteError: the file cannot be written, or is there already.
    """
    module = importlib.import_module(f"{__name__}.{name}")
    with atomic_file(path, replace=replace) as part:
        module.write(flight, part)
