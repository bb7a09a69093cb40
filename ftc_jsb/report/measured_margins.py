"""Margins that `ftc-jsb margins` measured, beside the flights that they belong to."""

import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from ftc_jsb.analysis.metrics import Metrics
from ftc_jsb.bounded_file import UnreadableError, read_bounded_text
from ftc_jsb.errors import RecordingError
from ftc_jsb.recording.flight import Flight
from ftc_jsb.resources import PAPER_AIRCRAFT

LARGEST = 16_000_000  # bytes; a file of ours has a hundredth
KEYS = {  # in a report: in margins.json
    "gain_margin_db": "gain_margin_inserted_db",
    "phase_margin_deg": "phase_margin_deg",
    "delay_margin_s": "delay_margin_inserted_s",
}


class MeasuredMargins(NamedTuple):
    """The least margins over the inputs of one aircraft, model and loop."""

    aircraft: str
    model: str
    loop: str
    least: Metrics


def read_margins(path: Path) -> MeasuredMargins:
    """Read a `margins.json`.

    Raises:
        RecordingError: no such file, or not what `ftc-jsb margins` writes.
    """
    try:
        document = json.loads(read_bounded_text(path, LARGEST))
        channels = list(document["channels"].values())
        least = {
            name: min((c[key] for c in channels if c[key] is not None), default=None)
            for name, key in KEYS.items()
        }
        if not all(_is_margin(value) for value in least.values()):
            raise TypeError
        whose = document["aircraft"], document["model"], document["loop"]
        if not all(isinstance(name, str) for name in whose):
            raise TypeError
        return MeasuredMargins(*whose, least)
    except UnreadableError as error:
        raise RecordingError(f"--margins {path}: {error}") from None
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise RecordingError(
            f"--margins {path}: expected a margins.json that `ftc-jsb margins` wrote"
        ) from None


def _is_margin(value: object) -> bool:
    return value is None or (
        isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
    )


def margins_of(flight: Flight, known: Sequence[MeasuredMargins]) -> Metrics:
    """Those of the flight's aircraft, model and loop; nothing where none were measured."""
    scenario = flight.scenario
    name = PAPER_AIRCRAFT if scenario.model == "paper" else scenario.aircraft.name
    for each in known:
        if (each.aircraft, each.model, each.loop) == (name, scenario.model, scenario.loop.name):
            return each.least
    return {}
