"""The proof of section 4.2 for a flight of the general loop: predicted from the flight of section 3."""

from collections.abc import Callable
from contextlib import suppress
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.errors import TheoryError
from ftc_jsb.theory.closed_loop import (
    NOTHING_ELSE,
    ClosedLoop,
    Conditions,
    History,
    Settings,
    Signal,
    filter_settings,
)
from ftc_jsb.theory.constants import ProofConstants, proof_constants
from ftc_jsb.theory.error_envelope import (
    FilterModel,
    Nominal,
    Response,
    error_envelope,
    response,
)
from ftc_jsb.theory.lyapunov import (
    Assumptions,
    Flown,
    LyapunovBound,
    disturbance_bound,
    lyapunov_bound,
)
from ftc_jsb.theory.system import System
from ftc_jsb.theory.zero_dynamics import input_scale

Array = npt.NDArray[np.float64]
STEP_MARGIN = 2.0  # on |u - u_n| of the nominal flights
STEP_FLOOR = 0.01  # of an input's size
STEP_WINDOW = 50.0  # in 1 / zeta: how much later than the nominal command the adaptive one may move
FLOOR = 1e-4  # of a state's range: integration, rounding, the unscented mean's second order
EFFECTIVENESS_FLOOR = 1e-3
STEP_OF_LOSS = 0.02  # change of k a sample that counts as a step


class Task(NamedTuple):
    """What is flown."""

    reference: Callable[[float], tuple[Array, Array]]
    effectiveness: Signal
    initial: Array
    trim: Array
    duration: float  # [s]


class Expected(NamedTuple):
    """What is expected of the flights of a task, whichever loop flies it with the estimate."""

    envelope: Array  # (rows, states + inputs), bound of |x^ - x| and |k^ - k|
    step: Array  # (rows, inputs), bound of |u - u_n|


def expect(
    loop: ClosedLoop, task: Task, settings: Settings, conditions: Conditions = NOTHING_ELSE
) -> Expected:
    """From four flights that know of no condition but whether sensors are noisy.

    All are of section 3, their laws know the state. The first knows each loss at once, the second no loss
    before the next: between them is the law that goes by the estimate, from the moment of a loss until it
    is told. The others go by what the filter tells of k along the first and along the second.

    Args:
        loop: with a plant that is the model.
        task: what will be flown.
        settings: of the loop.
        conditions: of which only whether there is noise is looked at.

    Raises:
        TheoryError: the flight that knows its losses at once does not come to its end, or a filter fails.
    """
    knowing = settings._replace(loop="oracle")
    nominal = [loop.fly(*task, knowing)]
    model = _filter_model(loop, settings)
    responses = [_response(model, nominal[0])]
    with suppress(TheoryError):  # a plant that no loop holds so long: the flights so far have to do
        for number in range(3):
            told = _told_late(nominal[0])
            if number > 0:
                estimate = np.maximum(responses[number - 1].told, settings.floor)
                told = _sampled(estimate, settings.dt)
            nominal.append(loop.fly(*task, knowing, Conditions(told=told)))
            responses.append(_response(model, nominal[-1]))
    noisy = conditions.sensor_noise is not None or conditions.plant_noise is not None
    envelope = error_envelope(responses, floor(loop.linearization.system), noisy)
    steps = [np.abs(flight.command - flight.trim) for flight in nominal]
    step = step_bound(steps, settings.zeta, settings.dt, input_scale(loop.linearization))
    return Expected(envelope, step)


def _filter_model(loop: ClosedLoop, settings: Settings) -> FilterModel:
    system = loop.linearization.system
    return FilterModel(
        loop.kernels.respond,
        loop.kernels.parameters,
        tuple(system.inputs.index(symbol) for symbol in system.fallible),
        filter_settings(settings),
        np.asarray(settings.initial_covariance, float),
    )


def _response(model: FilterModel, flight: History) -> Response:
    states = len(model.settings.process_noise) - len(model.fallible)
    return response(model, Nominal(flight.state[:, :states], flight.command), flight.effectiveness)


def _sampled(values: Array, dt: float) -> Signal:
    """A signal of time from its samples."""
    return lambda t: np.asarray(values[round(t / dt)])


def _told_late(flight: History) -> Signal:
    """The effectiveness as it was before its latest step; the first one where it has none."""
    k = flight.effectiveness
    steps = np.flatnonzero(np.abs(np.diff(k, axis=0)).max(axis=1) > STEP_OF_LOSS)
    start = flight.time[steps + 1]
    before = np.concatenate([np.ones_like(k[:1]), k[steps]])
    return lambda t: before[np.searchsorted(start, t, side="right")]


def fly_and_prove(
    loop: ClosedLoop,
    task: Task,
    settings: Settings,
    conditions: Conditions = NOTHING_ELSE,
    known: tuple[ProofConstants, Expected] | None = None,
) -> tuple[History, LyapunovBound]:
    """Predict, fly, compare.

    Args:
        loop: with a plant that is the model.
        task: what is flown.
        settings: of the loop.
        conditions: noise, limits and faults that no one declared: the prediction knows the noise of
            the sensors, and nothing else of them.
        known: constants of the system's ranges, and what is expected of the task, if they are at hand.
    """
    constants, expected = known or (
        proof_constants(loop.linearization),
        expect(loop, task, settings, conditions),
    )
    history = loop.fly(*task, settings, conditions)
    envelope = expected.envelope
    if settings.loop == "no-ftc":
        states = len(loop.linearization.system.states)
        envelope = envelope.copy()
        envelope[:, states:] = 1.0 - history.effectiveness + EFFECTIVENESS_FLOOR
    outputs = np.zeros(len(loop.linearization.index))
    assumptions = Assumptions(envelope, expected.step, outputs, *box(loop.linearization.system))
    rate = np.abs(np.gradient(history.derivative, settings.dt, axis=0))
    bound = disturbance_bound(constants, loop.gains.k, assumptions, rate, settings.dt)
    a, b, _ = loop.linearization.brunovsky()
    return history, lyapunov_bound(flown(history), bound, assumptions, (a, b), loop.gains)


def flown(history: History) -> Flown:
    """What the proof looks at; of the plant's states those of the model."""
    states = history.known.shape[1] - history.command.shape[1]
    return Flown(
        history.time,
        history.error,
        history.state[:, :states],
        history.effectiveness,
        history.known,
        history.wanted,
        history.command,
        history.trim,
    )


def step_bound(steps: list[Array], zeta: float, dt: float, scale: Array) -> Array:
    """(rows, inputs): bound of |u - u_n| from those of the nominal flights, a window wide.

    Args:
        steps: (rows, inputs) each.
        zeta: of (10) [1/s].
        dt: sample time [s].
        scale: (inputs,), size of each input.
    """
    from scipy.ndimage import maximum_filter1d

    rows = 2 * round(STEP_WINDOW / zeta / dt) + 1
    widest = maximum_filter1d(np.max(steps, axis=0), rows, axis=0)
    return np.asarray(STEP_MARGIN * widest + STEP_FLOOR * scale, dtype=np.float64)


def floor(system: System) -> Array:
    """(states + inputs,): error of an estimate that nothing excites."""
    width = [high - low for low, high in map(system.range_of, system.states)]
    return np.concatenate(
        [FLOOR * np.array(width), np.full(len(system.inputs), EFFECTIVENESS_FLOOR)]
    )


def box(system: System) -> tuple[Array, Array]:
    """Corners of the ranges of states and inputs, (states + inputs,)."""
    ranges = np.array([system.range_of(symbol) for symbol in (*system.states, *system.inputs)])
    return ranges[:, 0], ranges[:, 1]
