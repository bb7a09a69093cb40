"""Numbers, rows and tables of a typed file, and the checks of their knots and shapes."""

from typing import Annotated

from pydantic import Field

Number = Annotated[float, Field(ge=-1e9, le=1e9)]
Positive = Annotated[float, Field(ge=1e-9, le=1e9)]
Row = tuple[Number, ...]
Table = tuple[Row, ...]


def check_increasing(name: str, knots: Row, most: int) -> None:
    """Refuse knots that do not increase.

    Args:
        name: of the key.
        knots: its numbers.
        most: how many the kernels hold.

    Raises:
        ValueError: they do not, or there are none or too many.
    """
    if not 1 <= len(knots) <= most or list(knots) != sorted(set(knots)):
        raise ValueError(f"{name}: expected 1 to {most} increasing numbers")


def check_shape(name: str, table: Table, rows: int, columns: int) -> None:
    """Refuse a table of another shape.

    Args:
        name: of the key.
        table: its rows.
        rows: expected.
        columns: expected in each row.

    Raises:
        ValueError: it has another shape.
    """
    if len(table) != rows or any(len(row) != columns for row in table):
        raise ValueError(f"{name}: expected {rows} rows of {columns} numbers")
