"""What goes to the terminal: JSON to the standard output; messages and progress beside it."""

import json
from typing import Any

import click


def message(text: str) -> None:
    """Say one sentence on the standard error, under the program's name."""
    click.echo(f"ftc-jsb: {text}", err=True)


def progress_line(text: str) -> None:
    """Say how far a long command is, on the standard error."""
    click.echo(text, err=True)


def print_json(document: dict[str, Any]) -> None:
    """Print a document for machines."""
    click.echo(json.dumps(document, indent=2))
