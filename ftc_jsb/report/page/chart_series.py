"""The series behind the charts: computed at every sample in float64, then thinned and packed as float32."""

import base64
import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.command_following import AXES, commanded_and_achieved
from ftc_jsb.analysis.effectiveness_estimate import unobservable
from ftc_jsb.analysis.fault_detection import HEALTHY
from ftc_jsb.analysis.filter_health import INNOVATIONS, whitened
from ftc_jsb.analysis.tracking import position_errors, tracking_errors
from ftc_jsb.analysis.validity import MOTION, apart
from ftc_jsb.recording.flight import Flight
from ftc_jsb.report.fault_times import fault_times
from ftc_jsb.report.findings import Findings
from ftc_jsb.report.flight_groups import Flights, by_scenario, model_pairs
from ftc_jsb.report.page.envelope import equivalent_airspeed
from ftc_jsb.vocabulary.channels import CHANNELS, Channel
from ftc_jsb.vocabulary.quantities import KILO, QUANTITIES

Array = npt.NDArray[np.float64]
Columns = dict[str, Array]

MOST_POINTS = 3000  # of a flight, evenly spaced
ALL_POINTS = 18_000  # of all flights together: six full ones, 4 MB on the page
CLOSE = 1.0  # [s] before and after a fault in which no sample is left out
POSITION_LOOP = "path"  # tracks the position
PLACE = ("north", "east")
STATES = {  # on the page: in the recording
    "airspeed": "airspeed",
    "flight_path": "flight_path_angle",
    "heading": "heading",
}
LEAST_NIS = 1e-3  # below, a NIS is shown at this value: its axis is logarithmic


class Series(NamedTuple):
    """What is drawn of a flight."""

    columns: dict[str, str]  # base64 of little-endian float32
    every: int  # one sample of so many is kept


def flight_series(flights: Flights, findings: Findings) -> dict[str, Series]:
    """Series of each flight; those of pairs are with the point mass.

    All columns of a flight share one time axis: every n-th sample, every sample near a fault, and
    the samples at which a column has its extremes. So a peak in a table is there in the chart.
    """
    points = max(min(MOST_POINTS, ALL_POINTS // len(flights)), 200)
    partners = dict(model_pairs(flights))
    paths = _with_reference_path(flights)
    found = {}
    for label, flight in flights.items():
        columns = _columns(flight) | _envelope(flight) | _findings(label, flight, findings)
        if flight.scenario.loop.name == POSITION_LOOP or label in paths.tracked:
            columns |= position_errors(flight.record)
        if label in paths.longest:
            columns |= {f"{k}_ref": QUANTITIES[k].shown(flight.record[f"{k}_ref"]) for k in PLACE}
        if label in partners:
            columns |= _differences(flight, flights[partners[label]])
        columns = {name: values for name, values in columns.items() if np.isfinite(values).any()}
        every = max(math.ceil(flight.record.size / points), 1)
        rows = _kept(flight, columns, every)
        found[label] = Series({n: _packed(values[rows]) for n, values in columns.items()}, every)
    return found


class _Paths(NamedTuple):
    """Flights by label: whose place is judged, and of which the reference path is drawn."""

    tracked: set[str]
    longest: set[str]


def _with_reference_path(flights: Flights) -> _Paths:
    """All flights of a scenario that the position loop flew; the longest flight of each scenario."""
    tracked: set[str] = set()
    longest: set[str] = set()
    for members in by_scenario(flights).values():
        if any(flight.scenario.loop.name == POSITION_LOOP for flight in members.values()):
            tracked |= set(members)
        longest.add(max(members, key=lambda label: members[label].record["time"][-1]))
    return _Paths(tracked, longest)


def _envelope(flight: Flight) -> Columns:
    """What the V-n and the Mach-altitude panel are of, beside the load factor and the altitude."""
    r = flight.record
    return {"mach": r["mach"], "equivalent_airspeed": equivalent_airspeed(flight)}


def _columns(flight: Flight) -> Columns:
    """What the recording itself holds, in the units that are shown."""
    r = flight.record
    columns: Columns = {"time": r["time"]}
    columns |= {name: QUANTITIES[name].shown(r[name]) for name in ("north", "east", "altitude")}
    columns |= {name: QUANTITIES[of].shown(r[of]) for name, of in STATES.items()}
    columns |= {f"{name}_ref": QUANTITIES[of].shown(r[f"{of}_ref"]) for name, of in STATES.items()}
    columns |= {
        **tracking_errors(r),
        "thrust_command": QUANTITIES["thrust_cmd"].shown(r["thrust_cmd"]),
        "detector": r["fault_statistic"],
        "declared": np.where(r["fault_declared"] > 0.5, r["fault_statistic"], np.nan),
        "nis": np.maximum(r["innovation_squared"], LEAST_NIS),
    }
    for axis in AXES:
        command, achieved = commanded_and_achieved(flight, axis)
        columns[f"{axis.name}_wanted"], columns[f"{axis.name}_flown"] = command, achieved
    for name in INNOVATIONS:
        columns[f"innovation_{name}"] = whitened(r, name)
    for channel in CHANNELS:
        columns |= _effectiveness(flight, channel)
    return columns


def _effectiveness(flight: Flight, channel: Channel) -> Columns:
    """Truth and estimate of a channel; nothing of one that nobody estimates and that is healthy."""
    r, name = flight.record, f"effectiveness_{channel}"
    estimate, deviation = r[f"{name}_est"], r[f"{name}_std"]
    columns: Columns = {}
    if np.isfinite(estimate).any() or np.nanmin(r[name]) < HEALTHY or channel == "thrust":
        columns[f"{name}_true"] = r[name]
    columns |= {
        f"{name}_estimate": estimate,
        f"{name}_error": estimate - r[name],
        f"{name}_deviation": deviation,
    }
    if channel in flight.scenario.loop.estimator.channels:
        columns[f"{name}_lost"] = np.where(unobservable(flight, channel), deviation, np.nan)
    return columns


def _findings(label: str, flight: Flight, findings: Findings) -> Columns:
    columns: Columns = {}
    if label in findings.residuals:
        for name, values in findings.residuals[label]._asdict().items():
            columns[f"residual_{name}"] = KILO * values  # kN
    if label in findings.proofs:
        proof = findings.proofs[label]
        columns["lyapunov"], columns["lyapunov_bound"] = proof.value, proof.bound
        columns["scaled_error"] = proof.error
        columns["ball"] = proof.predicted
    return columns


def _differences(point_mass: Flight, six_dof: Flight) -> Columns:
    """Point mass minus JSBSim on the point mass's samples; nan where only one flew."""
    count = min(point_mass.record.size, six_dof.record.size)
    columns: Columns = {}
    for variable in MOTION:
        values = np.full(point_mass.record.size, np.nan)
        one, other = (flight.record[variable.name][:count] for flight in (point_mass, six_dof))
        values[:count] = variable.shown(one - other)
        columns[f"difference_{variable.name}"] = values
    distance = np.full(point_mass.record.size, np.nan)
    distance[:count] = apart(point_mass, six_dof)
    columns["difference_position"] = distance
    return columns


def _kept(flight: Flight, columns: Columns, every: int) -> npt.NDArray[np.int64]:
    """Rows that are shown."""
    rows = flight.record.size
    keep = np.zeros(rows, dtype=bool)
    keep[::every] = keep[-1] = True
    for time in fault_times(flight):
        keep |= np.abs(flight.record["time"] - time) <= CLOSE
    for values in columns.values():
        keep[np.nanargmin(values)] = keep[np.nanargmax(values)] = True
    return np.flatnonzero(keep)


def _packed(values: Array) -> str:
    return base64.b64encode(values.astype("<f4").tobytes()).decode("ascii")
