"""What goes to the terminal: JSON to the standard output; messages and progress beside it."""

import contextlib
import json
import os
import sys
from collections.abc import Iterator
from typing import Any, TextIO

import click


class _Hush:
    """What --quiet leaves of the output."""

    output: TextIO | None = None  # the standard output, for JSON, while results are hushed


def message(text: str) -> None:
    """Say one sentence on the standard error, under the program's name."""
    click.echo(f"ftc-jsb: {text}", err=True)


def note(text: str) -> None:
    """Say what is worth knowing and no failure."""
    if _Hush.output is None:
        message(f"note: {text}")


def progress_line(text: str) -> None:
    """Say how far a long command is, on the standard error."""
    if _Hush.output is None:
        click.echo(text, err=True)


def print_json(document: dict[str, Any]) -> None:
    """Print a document for machines."""
    click.echo(json.dumps(document, indent=2), file=_Hush.output)


def is_quiet() -> bool:
    """Whether the user wants no progress, notes and tables."""
    return _Hush.output is not None


@contextlib.contextmanager
def hushed() -> Iterator[None]:
    """Tables, notes and progress go nowhere; failures and JSON are printed."""
    _Hush.output = sys.stdout
    try:
        with open(os.devnull, "w") as nowhere, contextlib.redirect_stdout(nowhere):
            yield
    finally:
        _Hush.output = None
