"""The flights of cases, on whatever machine: rows of numbers, and recordings where they are kept."""

import tempfile
import time
import traceback
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

from ftc_jsb.analysis.fault_detection import HEALTHY
from ftc_jsb.analysis.metrics import Metrics, flight_metrics
from ftc_jsb.analysis.robustness import estimate_margin, robustness_margin
from ftc_jsb.analysis.verdict import passed
from ftc_jsb.campaign.case import Bases, Case, case_of, flights_of, scenario_of_case
from ftc_jsb.campaign.detection import peak_statistics
from ftc_jsb.campaign.load import unpacked
from ftc_jsb.campaign.provenance import code_digest
from ftc_jsb.errors import UserError
from ftc_jsb.recording.flight import Flight
from ftc_jsb.recording.netcdf import save
from ftc_jsb.simulation.series import Series

Row = dict[str, Any]
NOT_ROWS = ("real_time_factor",)  # of the machine, not of the flight


class Item(NamedTuple):
    """What a worker is asked for: a case, at a point of its own where a search says so."""

    number: int
    unit: tuple[float, ...] | None = None


class Work(NamedTuple):
    """A campaign on its way to a worker."""

    campaign: str  # of `load.packed`
    code: str  # digest of the program that shares it out
    keep: str  # recordings: none, failed or all


class Batch(NamedTuple):
    """What a worker gives back."""

    rows: list[Row]
    recordings: dict[tuple[int, str], bytes]  # NetCDF, by case and label
    seconds: float  # that it took


def fly_items(work: Work, items: Sequence[Item]) -> Batch:
    """Fly cases. What goes wrong with one is a row with its reason.

    Args:
        work: the campaign.
        items: the cases.

    Raises:
        UserError: this machine has another version of the program.
    """
    if work.code != code_digest():
        raise UserError("a worker has another version of ftc-jsb, or of what it flies with")
    bases = _bases(work.campaign)
    series = Series()
    started = time.perf_counter()
    rows: list[Row] = []
    recordings: dict[tuple[int, str], bytes] = {}
    for item in items:
        case, reason = drawn_case(bases, item)
        for model, loop in flights_of(bases):
            row, flight = _flown(series, case, (model, loop), reason)
            rows.append(row)
            if flight is not None and _kept(work.keep, row):
                recordings[item.number, flight.label] = _netcdf(flight)
    return Batch(rows, recordings, time.perf_counter() - started)


def identity(case: Case, model: str | None, loop: str) -> Row:
    """The first columns of a row: which flight, of what drawn values."""
    parameters = {f"parameter.{key}": value for key, value in case.parameters.items()}
    row = {
        "case": case.number,
        "model": model or case.values.get("model"),
        "loop": loop,
        **parameters,
    }
    return row | {"point": list(case.unit)} if case.unit else row


def row_of(flight: Flight) -> Row:
    """Every number of a flight, flat: those of metrics.json, its margins, the detector's peaks."""
    metrics = flight_metrics(flight)
    margin = robustness_margin(flight, metrics)
    return {
        "verdict": metrics["verdict"],
        "error": None,
        "margin": margin.value,
        "margin_limit": margin.limit,
        "margin_time_s": margin.time,
        "margin_estimate": estimate_margin(metrics),
        **_flat(metrics),
        "fault_s": float(_faulty(flight) * flight.row_period),
        **peak_statistics(flight.record),
    }


@lru_cache(maxsize=2)
def _bases(text: str) -> Bases:
    return unpacked(text)


def drawn_case(bases: Bases, item: Item) -> tuple[Case, str]:
    """The case of an item, and why it cannot be flown; empty if it can."""
    try:
        return case_of(bases, item.number, item.unit), ""
    except UserError as error:
        return Case(item.number, item.unit or (), {}, {}), str(error)


def _flown(
    series: Series, case: Case, pair: tuple[str | None, str], reason: str
) -> tuple[Row, Flight | None]:
    row = identity(case, *pair)
    if reason:
        return row | {"verdict": None, "error": reason}, None
    try:
        flight = series.fly(scenario_of_case(case, *pair))
        if flight.outcome.status == "interrupted":  # by Ctrl-C, which `fly` makes an outcome of
            raise KeyboardInterrupt
        return row | row_of(flight), flight
    except UserError as error:
        return row | {"verdict": None, "error": str(error)}, None
    except Exception as error:  # whatever it is, the other cases go on
        place = traceback.extract_tb(error.__traceback__)[-1]
        text = f"{type(error).__name__}: {error} ({Path(place.filename).name}:{place.lineno})"
        return row | {"verdict": None, "error": text}, None


def _flat(metrics: Metrics) -> Row:
    row: Row = {}
    for key, value in metrics.items():
        if key in NOT_ROWS:
            continue
        if isinstance(value, dict):
            row |= {f"{key}.{inner}": number for inner, number in value.items()}
        elif key == "limits_broken":
            row[key] = " ".join(dict.fromkeys(limit["name"] for limit in value))
        elif isinstance(value, list | tuple):
            row[key] = str(value)
        else:
            row[key] = value
    return row


def _faulty(flight: Flight) -> int:
    """Rows at which the thrust is not healthy."""
    return int((flight.record["effectiveness_thrust"] < HEALTHY).sum())


def _kept(keep: str, row: Row) -> bool:
    return keep == "all" or (keep == "failed" and not passed(row))


def _netcdf(flight: Flight) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "flight.nc"
        save(flight, path)
        return path.read_bytes()
