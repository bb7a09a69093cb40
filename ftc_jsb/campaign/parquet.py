"""Rows as Parquet, written atomically: a column is there if any row has it, of numbers or of texts."""

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
import pyarrow.parquet

from ftc_jsb.errors import RecordingError

Row = dict[str, Any]
HEAD = (  # columns that come first; the others follow by name
    "case", "model", "loop", "verdict", "error", "margin", "margin_limit", "margin_time_s",
)  # fmt: skip


@contextmanager
def writing(path: Path) -> Iterator[Path]:
    """A path to write to, which becomes `path` when all of it is on the disk, and is gone if not."""
    part = path.with_name(f"{path.name}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield part
        with part.open("rb") as file:
            os.fsync(file.fileno())
        part.replace(path)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise RecordingError(f"{path}: cannot be written: {error}") from None


def read_rows(path: Path, columns: list[str] | None = None) -> list[Row]:
    """Rows of a Parquet file; of `columns` those that it has.

    Raises:
        RecordingError: not one, or damaged.
    """
    try:
        file = pyarrow.parquet.ParquetFile(path)
        wanted = None if columns is None else [c for c in columns if c in file.schema_arrow.names]
        return list(file.read(columns=wanted).to_pylist())
    except (OSError, pyarrow.ArrowException) as error:
        raise RecordingError(f"{path}: cannot be read: {error}") from None


def write_rows(rows: Sequence[Row], path: Path) -> None:
    """Write rows; columns stand in the order of the first rows that have them.

    Raises:
        RecordingError: the file cannot be written.
    """
    names = list(dict.fromkeys(name for row in rows for name in row))
    columns = [_column([row.get(name) for row in rows]) for name in names]
    _write(pyarrow.Table.from_arrays(columns, names=names), path)


def merge(paths: Sequence[Path], target: Path, end: int) -> None:
    """Write the rows of several files as one, by their `case`, those below `end`.

    Whatever the files were cut into, the result is the same.

    Raises:
        RecordingError: a file cannot be read or written.
    """
    try:
        tables = [pyarrow.parquet.ParquetFile(path).read() for path in paths]
    except (OSError, pyarrow.ArrowException) as error:
        raise RecordingError(f"{target.parent}: cannot be read: {error}") from None
    if not tables:
        raise RecordingError(f"{target.parent}: has no finished batch")
    names = dict.fromkeys(name for table in tables for name in table.column_names)
    ordered = [name for name in HEAD if name in names] + sorted(set(names) - set(HEAD))
    whole = pyarrow.Table.from_arrays([_joined(tables, name) for name in ordered], names=ordered)
    cases = whole["case"].to_numpy()
    order = np.argsort(cases, kind="stable")
    _write(whole.take(order[cases[order] < end]), target)


def _joined(tables: Sequence[Any], name: str) -> Any:
    """A column of all tables, in one type: text where one of them has text, else a number of floating point."""
    parts = [
        table[name].combine_chunks() if name in table.column_names else pyarrow.nulls(len(table))
        for table in tables
    ]
    kinds = {part.type for part in parts} - {pyarrow.null()}
    if len(kinds) <= 1:
        kind = kinds.pop() if kinds else pyarrow.null()
        return pyarrow.chunked_array([part.cast(kind) for part in parts])
    return _column([value for part in parts for value in part.to_pylist()])


def _column(values: list[Any]) -> Any:
    known = [value for value in values if value is not None]
    if any(isinstance(value, str) for value in known):
        return pyarrow.array([None if value is None else str(value) for value in values])
    if any(isinstance(value, float) for value in known):
        numbers = [None if value is None else float(value) for value in values]
        return pyarrow.array(numbers, pyarrow.float64())
    return pyarrow.array(values)


def _write(table: Any, path: Path) -> None:
    with writing(path) as part:
        pyarrow.parquet.write_table(table, part, compression="zstd")
