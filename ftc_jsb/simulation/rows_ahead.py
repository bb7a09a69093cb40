"""Rows to come, rewritten by commands in flight: a stretch ahead, whatever is left of the flight.

A command costs the same at the start of a long flight as at its end. What a row says is the same as if
the rows had been rewritten to the end at once.
"""

from collections.abc import Callable

LENGTH = 256  # rows that a command writes at once; further ones are written as they are reached

Write = Callable[[int, int], None]  # first row, row beyond


class RowsAhead:
    """Who writes which rows to come, and how far they are written."""

    def __init__(self, rows: int) -> None:
        """Args: rows of the whole recording, which has been filled from the scenario."""
        self._rows = rows
        self._writers: dict[str, Write] = {}
        self._written: dict[str, int] = {}  # row beyond
        self._short = rows  # the first row that a writer has yet to write

    def rewrite(self, columns: str, row: int, write: Write) -> None:
        """Have `write` write rows `row` and later.

        Args:
            columns: what is written, by a name: who wrote it before is forgotten.
            row: the first to be rewritten.
            write: rewrites the rows of a range; called for one range after the other.
        """
        self._writers[columns], self._written[columns] = write, row
        self._write(columns, min(row + LENGTH, self._rows))

    def reach(self, beyond: int) -> None:
        """Have the rows before `beyond` and the row itself written: a sample reads one row ahead."""
        beyond = min(beyond + 1, self._rows)
        if beyond <= self._short:
            return
        for columns, written in self._written.items():
            if written < beyond:
                self._write(columns, min(max(beyond, written + LENGTH), self._rows))

    def _write(self, columns: str, beyond: int) -> None:
        self._writers[columns](self._written[columns], beyond)
        self._written[columns] = beyond
        self._short = min(self._written.values())
