"""A case of the theory in the terminal."""

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from ftc_jsb.runs.theory import Analysis, TheoryFlight

Array = npt.NDArray[np.float64]


def theory_lines(analysis: Analysis, flights: dict[str, TheoryFlight]) -> Iterator[str]:
    """Index, F, G, zero dynamics, constants and gains; then a line for each flight."""
    linear, found = analysis.linearization, analysis.bounds
    yield analysis.case.title
    yield f"index of each output: {', '.join(map(str, linear.index))}"
    for row, element in enumerate(linear.drift):
        yield f"F[{row}] = {element}"
    for row in range(linear.gain.rows):
        yield f"G[{row}] = [{', '.join(map(str, linear.gain[row, :]))}]"
    zeros = analysis.zero_dynamics
    at = ", ".join(f"{zero:.3g}" for zero in zeros.zeros)
    yield f"zero dynamics at the start: {zeros.verdict}{f', zeros {at}' if at else ''}"
    yield (
        f"over the ranges: g_M = L_1 {found.gain}, L_2 {found.remainder}, M {found.curvature} "
        "(||O|| <= M/2 ||u - u_n||^2)"
    )
    for words in found.unbounded:
        yield f"Assumption 2 and Proposition 4 fail for inputs without limit: {words}"
    yield f"K = {np.array2string(analysis.loop.gains.k, precision=4, separator=', ')}"
    for name, flight in flights.items():
        yield f"{name}: {_flight_words(flight)}"


def _flight_words(flight: TheoryFlight) -> str:
    if not flight.whole:
        return f"flown to {flight.history.time[-1]:.3f}; {flight.problem}"
    words = f"largest |e| {_each(np.abs(flight.history.error).max(axis=0))}"
    if flight.proof is None:
        return f"{words}; {flight.problem}"
    if flight.proof.obeyed:
        each = _each(flight.proof.predicted_each.max(axis=0))
        return f"{words}; V below its bound, |e| predicted within {each}"
    reasons = [*flight.proof.broken, *([] if flight.proof.below else ["V exceeds its bound"])]
    return f"{words}; outside the proof: {'; '.join(reasons)}"


def _each(values: Array) -> str:
    """Numbers of different sizes, each with three digits."""
    return ", ".join(f"{value:.3g}" for value in values)
