"""The proof of section 4.2 for a flight of the general loop: predicted from the flight of section 3."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.theory.closed_loop import (
    NOTHING_ELSE,
    ClosedLoop,
    Conditions,
    History,
    Settings,
    Signal,
)
from ftc_jsb.theory.constants import ProofConstants, proof_constants
from ftc_jsb.theory.error_envelope import FilterModel, Nominal, error_envelope
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


class Task(NamedTuple):
    """What is flown."""

    reference: Callable[[float], tuple[Array, Array]]
    effectiveness: Signal
    initial: Array
    trim: Array
    duration: float  # [s]


def fly_and_prove(
    loop: ClosedLoop,
    task: Task,
    settings: Settings,
    conditions: Conditions = NOTHING_ELSE,
    constants: ProofConstants | None = None,
) -> tuple[History, LyapunovBound]:
    """Predict, fly, compare.

    Args:
        loop: with a plant that is the model.
        task: what is flown.
        settings: of the loop.
        conditions: noise, limits and faults that no one declared: the prediction knows the noise of
            the sensors, and nothing else of them.
        constants: of the system's ranges, if they are at hand.
    """
    oracle = settings._replace(loop="oracle")
    healthy = task._replace(effectiveness=lambda t: np.ones(len(task.trim)))
    nominal = [loop.fly(*each, oracle) for each in (task, healthy)]
    history = loop.fly(*task, settings, conditions)
    constants = constants or proof_constants(loop.linearization)
    assumptions = _assumptions(loop, nominal, settings, conditions)
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


def _assumptions(
    loop: ClosedLoop, nominal: list[History], settings: Settings, conditions: Conditions
) -> Assumptions:
    system, kernels = loop.linearization.system, loop.kernels
    faults = tuple(system.inputs.index(symbol) for symbol in system.fallible)
    model = FilterModel(
        kernels.propagate,
        kernels.outputs,
        kernels.parameters,
        faults,
        np.asarray(settings.process_noise, float),
        np.asarray(settings.measurement_noise, float),
        np.asarray(settings.initial_covariance, float),
        settings.dt,
    )
    states = len(system.states)
    flights = [Nominal(each.state[:, :states], each.command) for each in nominal]
    truth = nominal[0].effectiveness
    noisy = conditions.sensor_noise is not None or conditions.plant_noise is not None
    envelope = error_envelope(model, flights, truth, floor(system), noisy)
    if settings.loop == "no-ftc":
        envelope[:, states:] = 1.0 - truth + EFFECTIVENESS_FLOOR
    steps = [np.abs(flight.command - flight.trim) for flight in nominal]
    step = step_bound(steps, settings.zeta, settings.dt, input_scale(loop.linearization))
    low, high = box(system)
    return Assumptions(envelope, step, np.zeros(len(system.outputs)), low, high)


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
