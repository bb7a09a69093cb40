"""How far the joint estimate will be from the truth: the filter run on nominal flights.

A nominal flight is that of section 3, with state and fault known: nothing of the adaptive flight is in
it. Told what is measured along it, the filter (26)-(34) errs after each step of k
(`kernels/error_response.py`), and the assumption of the proof that x~ is bounded gets its numbers before
the flight.
"""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.errors import TheoryError
from ftc_jsb.theory.kernels.joint_filter import SOUND, FilterSettings

Array = npt.NDArray[np.float64]
MARGIN = 1.5  # on the response: the adaptive flight's inputs lie between those of the nominal ones
SIGMAS = 4.0  # of the filter's own covariance, where sensors are noisy


class Nominal(NamedTuple):
    """A flight with state and fault known."""

    state: Array  # (rows, states)
    command: Array  # (rows, inputs)


class FilterModel(NamedTuple):
    """What the response needs of a filter."""

    respond: Any  # `kernels/error_response.py`
    parameters: Array
    fallible: tuple[int, ...]  # inputs whose effectiveness is in the filter's state
    settings: FilterSettings
    initial_covariance: Array  # (states + faults,)


class Response(NamedTuple):
    """Of a filter to what is measured along a nominal flight."""

    envelope: Array  # (rows, states + inputs), of |x^ - x| and |k^ - k|
    deviation: Array  # (rows, states + inputs), the filter's own
    told: Array  # (rows, inputs), k^


def response(model: FilterModel, nominal: Nominal, effectiveness: Array) -> Response:
    """Run a filter on what is measured along a nominal flight, without noise.

    Args:
        model: of the filter.
        nominal: the flight.
        effectiveness: (rows, inputs), k of that flight.

    Raises:
        TheoryError: the filter's covariance does not stay positive definite.
    """
    rows, n = nominal.state.shape
    places = [*range(n), *(n + fault for fault in model.fallible)]
    found, deviation = (np.zeros((rows, len(places))) for _ in range(2))
    told, covariance = np.empty_like(effectiveness), np.diag(model.initial_covariance)
    status = model.respond(
        tuple(map(np.ascontiguousarray, (*nominal, effectiveness))),
        model.parameters,
        model.settings,
        covariance,
        found,
        deviation,
        told,
    )
    if status != SOUND:
        raise TheoryError("the filter's covariance does not stay positive definite")
    whole = np.zeros((2, rows, n + effectiveness.shape[1]))
    whole[0][:, places], whole[1][:, places] = found, deviation
    return Response(whole[0], whole[1], told)


def error_envelope(responses: list[Response], floor: Array, noisy: bool) -> Array:
    """(rows, states + inputs): bound of |x^ - x| and |k^ - k|, the largest over the nominal flights.

    Args:
        responses: along flights between which the inputs of the adaptive flight lie.
        floor: (states + inputs,), always added: rounding and integration.
        noisy: whether sensors are, so that the filter's deviation counts.
    """
    bounds = [each.envelope + SIGMAS * noisy * each.deviation for each in responses]
    return np.asarray(MARGIN * np.max(bounds, axis=0) + floor, dtype=np.float64)
