"""`metrics.json`: what is in it, and how it is written."""

import json
from pathlib import Path
from typing import Any

from ftc_jsb.analysis.metrics import Metrics
from ftc_jsb.atomic_file import write_text


def document(metrics: dict[str, Metrics]) -> dict[str, Any]:
    """The contents of `metrics.json`."""
    return {"flights": metrics}


def write_metrics(path: Path, contents: dict[str, Any]) -> None:
    """Write `metrics.json`; unknown numbers are null, never NaN, which is no JSON.

    Raises:
        WriteError: the file cannot be written.
    """
    write_text(path, json.dumps(contents, indent=2, allow_nan=False) + "\n")
