"""`metrics.json`: what is in it, and how it is written."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ftc_jsb.atomic_file import write_text
from ftc_jsb.runs.finite_numbers import finite

if TYPE_CHECKING:
    from ftc_jsb.analysis.metrics import Metrics


def document(metrics: "dict[str, Metrics]") -> dict[str, Any]:
    """The contents of `metrics.json`."""
    return {"flights": {label: finite(entry) for label, entry in metrics.items()}}


def write_metrics(path: Path, contents: dict[str, Any]) -> None:
    """Write `metrics.json`; unknown numbers are null.

    Raises:
        WriteError: the file cannot be written.
    """
    write_text(path, json.dumps(finite(contents), indent=2, allow_nan=False) + "\n")
