"""A case of the theory: found by name or in a file, analysed, flown, and written."""

import importlib.util
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple, cast

import numpy as np

from ftc_jsb.errors import RecordingError, TheoryError
from ftc_jsb.theory.bounds import Bounds
from ftc_jsb.theory.case import Case
from ftc_jsb.theory.closed_loop import ClosedLoop, FlightEndedError, History, Loop
from ftc_jsb.theory.constants import ProofConstants
from ftc_jsb.theory.derived import derive
from ftc_jsb.theory.linearization import Linearization
from ftc_jsb.theory.lyapunov import LyapunovBound
from ftc_jsb.theory.proof import Expected, expect, fly_and_prove
from ftc_jsb.theory.systems import CASES
from ftc_jsb.theory.zero_dynamics import ZeroDynamics, zero_dynamics

LOOPS: tuple[Loop, ...] = ("ftc", "ekf", "no-ftc", "oracle")


class Analysis(NamedTuple):
    """What is known of a case before it is flown."""

    case: Case
    linearization: Linearization
    zero_dynamics: ZeroDynamics
    bounds: Bounds
    constants: ProofConstants
    loop: ClosedLoop


class TheoryFlight(NamedTuple):
    """A flight of the case by one loop, whole or up to where it could not go on."""

    history: History
    proof: LyapunovBound | None  # None: not whole, another plant, or nothing could be predicted
    problem: str  # why there is no proof
    whole: bool = True


def load_case(name: str) -> Case:
    """A shipped case, or CASE of a Python file.

    Raises:
        TheoryError: neither; or the file fails, or has no CASE.
    """
    if name in CASES:
        return CASES[name]()
    path = Path(name)
    if not path.is_file():
        raise TheoryError(f"{name}: no such case; expected a FILE.py or one of {', '.join(CASES)}")
    spec = importlib.util.spec_from_file_location(path.stem, path)
    if spec is None or spec.loader is None:
        raise TheoryError(f"{path}: is no Python file; expected one that defines CASE")
    module = importlib.util.module_from_spec(spec)
    sys.modules.setdefault(path.stem, module)
    try:
        spec.loader.exec_module(module)
    except TheoryError as error:
        raise TheoryError(f"{path}: {error}") from None
    except Exception as error:
        raise TheoryError(f"{path}: {type(error).__name__}: {error}") from None
    found = getattr(module, "CASE", None)
    if not isinstance(found, Case):
        raise TheoryError(f"{path}: CASE is {found!r}; expected a ftc_jsb.theory.case.Case")
    return found


def analyse(case: Case) -> Analysis:
    """Index, F, G, zero dynamics, bounds and gains.

    Raises:
        TheoryError: the theory does not cover the system, or the gains are none for it.
    """
    linear, found, constants, kernels = derive(case.system, case.plant)
    return Analysis(
        case,
        linear,
        zero_dynamics(linear, list(case.initial), list(case.trim)),
        found,
        constants,
        ClosedLoop(linear, case.gains(linear), case.plant, kernels),
    )


def foresee(analysis: Analysis) -> Expected | str:
    """What is expected of the flights of a case, or why nothing can be."""
    case = analysis.case
    if case.plant is not None:
        return "the plant is not the model, so no bound is predicted"
    try:
        with _without_warnings():
            task = case.task(analysis.linearization)
            return expect(analysis.loop, task, case.settings, case.conditions)
    except TheoryError as error:
        return f"no bound is predicted, for told state and fault: {error}"


def fly_case(analysis: Analysis, name: Loop, seed: int, expected: Expected | str) -> TheoryFlight:
    """Fly by one loop; a flight that ends early is told, not raised, and kept as far as it went.

    Args:
        analysis: of the case.
        name: of the loop.
        seed: of the noise.
        expected: by `foresee`.
    """
    case, loop = analysis.case, analysis.loop
    settings = case.settings._replace(loop=name)
    conditions = case.conditions._replace(seed=seed)
    task = case.task(analysis.linearization)
    try:
        with _without_warnings():
            if isinstance(expected, str):
                return TheoryFlight(loop.fly(*task, settings, conditions), None, expected)
            known = (analysis.constants, expected)
            history, proof = fly_and_prove(loop, task, settings, conditions, known)
            return TheoryFlight(history, proof, "")
    except FlightEndedError as error:
        return TheoryFlight(error.history, None, str(error), whole=False)


@contextmanager
def _without_warnings() -> Iterator[None]:
    """What is warned of, the zero dynamics, is in the analysis."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def document(analysis: Analysis, flights: dict[str, TheoryFlight]) -> dict[str, Any]:
    """The contents of `theory.json`."""
    import sympy as sp

    linear, zeros, found = analysis.linearization, analysis.zero_dynamics, analysis.bounds
    return {
        "system": linear.system.name,
        "title": analysis.case.title,
        "index": list(linear.index),
        "drift": [str(element) for element in linear.drift],
        "gain": [[str(element) for element in row] for row in linear.gain.tolist()],
        "drift_latex": sp.latex(linear.drift),
        "gain_latex": sp.latex(linear.gain),
        "zero_dynamics": {
            "dimension": zeros.dimension,
            "verdict": zeros.verdict,
            "zeros": [[float(zero.real), float(zero.imag)] for zero in zeros.zeros],
        },
        "bounds": {
            name: {
                "least": enclosure.least,
                "most": enclosure.most if enclosure.certified else None,
                "certified": enclosure.certified,
            }
            for name, enclosure in found._asdict().items()
            if name != "unbounded"
        },
        "unbounded": list(found.unbounded),
        "gains": analysis.loop.gains.k.tolist(),
        "flights": {name: _flight_document(flight) for name, flight in flights.items()},
    }


def _flight_document(flight: TheoryFlight) -> dict[str, Any]:
    error = flight.history.error
    entry: dict[str, Any] = {
        "rms_error": np.sqrt(np.mean(error**2, axis=0)).tolist(),
        "largest_error": np.abs(error).max(axis=0).tolist(),
    }
    if not flight.whole:
        entry |= {"problem": flight.problem, "end_time": float(flight.history.time[-1])}
    if flight.proof is not None:
        entry["proof"] = {
            "decay_rate": flight.proof.rate,
            "ball_radius": flight.proof.radius,
            "predicted_error": float(flight.proof.predicted.max()),
            "predicted_each": flight.proof.predicted_each.max(axis=0).tolist(),
            "largest_error": float(flight.proof.error.max()),
            "bound_obeyed": flight.proof.obeyed,
            "assumptions_broken": list(flight.proof.broken),
        }
    return entry


def write_history(case: Case, history: History, path: Path) -> None:
    """A flight as NetCDF: a variable for each state, input and output, in the case's own units.

    Raises:
        RecordingError: the file cannot be written.
    """
    import netCDF4

    try:
        with netCDF4.Dataset(path, "w") as file:
            file.setncatts({"title": case.title, "system": case.system.name})
            file.createDimension("time", history.time.size)
            for name, values in _columns(case, history).items():
                column = file.createVariable(name, float, "time", fill_value=np.nan, zlib=True)
                column[:] = values
            file["time"].units = case.time_unit
    except (OSError, RuntimeError) as error:
        raise RecordingError(f"{path}: cannot be written: {error}") from None


def _columns(case: Case, history: History) -> dict[str, Any]:
    system = case.system
    states = [str(symbol) for symbol in system.states]
    inputs = [str(symbol) for symbol in system.inputs]
    factors = [f"effectiveness_{symbol}" for symbol in system.fallible]
    flown = [str(symbol) for symbol in (case.plant or system).states]
    named: dict[str, tuple[list[str], Any]] = {
        "{}": (flown, history.state),
        "{}_est": (states + factors, history.estimate),
        "{}_std": (states + factors, history.deviation),
        "effectiveness_{}": (inputs, history.effectiveness),
        "{}_cmd": (inputs, history.command),
        "{}_delivered": (inputs, history.delivered),
        "trim_input_{}": (inputs, history.trim),
        "error_{}": ([str(place) for place in range(history.error.shape[1])], history.error),
        "ref_{}": ([str(place) for place in range(history.error.shape[1])], history.reference),
        "measured_{}": ([str(p) for p in range(history.measured.shape[1])], history.measured),
    }
    columns = {"time": history.time}
    for form, (names, values) in named.items():
        columns |= {form.format(n): values[:, place] for place, n in enumerate(names)}
    return cast(dict[str, Any], columns)
