"""A sample of the closed loop (35), (36) after another: plant, joint estimate, law, trim filter."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled, compiled_in_memory
from ftc_jsb.theory.discrete_model import make_propagate
from ftc_jsb.theory.generated import Kernels
from ftc_jsb.theory.joint_filter import FilterSettings, make_filter
from ftc_jsb.theory.law import SOLVED, Reference, make_law
from ftc_jsb.theory.trim_filter import trim_step

Array = npt.NDArray[np.float64]
NOT_FINITE = 1000  # status of a flight whose state left the finite numbers


class Settings(NamedTuple):
    """Numbers of the loop; diagonals for the covariances."""

    dt: float  # [s]
    zeta: float  # of (10) [1/s]
    process_noise: Array  # Q: states, then faults
    measurement_noise: Array  # R
    initial_covariance: Array  # P0
    floor: float = 0.05  # sigma
    spread: float = 3.0  # n_a + kappa
    adaptive: bool = True  # False: the true effectiveness in the law, no filter
    substeps: int = 4  # Runge-Kutta steps of the plant a sample


class History(NamedTuple):
    """What was flown, a row for each sample."""

    time: Array  # (rows,)
    state: Array  # (rows, states)
    estimate: Array  # (rows, states + faults)
    deviation: Array  # (rows, states + faults)
    effectiveness: Array  # (rows, inputs), the truth
    command: Array  # (rows, inputs)
    trim: Array  # (rows, inputs), u_n
    error: Array  # (rows, order), e of (16) with the true state
    residual: Array  # (rows, outputs), y^(r) - (y_m^(r) - K e): what the proof calls P x~ and O(.)


class LoopState(NamedTuple):
    """What changes from sample to sample, in place."""

    x: Array  # (states,), the true state
    z: Array  # (states + faults,), the joint estimate of (20)
    covariance: Array  # (states + faults, states + faults), of the estimate
    u_n: Array  # (inputs,), trim input of (10)
    u: Array  # (inputs,), command


class Constants(NamedTuple):
    """What is constant over a flight."""

    gain: Array  # (outputs, order), K of (17)
    parameters: Array  # (parameters,), of the system
    settings: Settings


def make_run(kernels: Kernels, states: int, inputs: int, order: int) -> Callable[..., Any]:
    """`run(state, reference, constants, history) -> (status, row)`: a flight in one compiled call.

    `reference` has a row for each sample; `history` receives them. The status is SOLVED, NOT_FINITE,
    or what the law returned, and the row is where it came to be.
    """
    know, record = _make_know(kernels, states, inputs), _make_record(kernels, inputs, order)
    law, propagate = make_law(kernels), make_propagate(kernels)

    @compiled_in_memory
    def run(
        state: LoopState, reference: Reference, constants: Constants, history: History
    ) -> tuple[int, int]:
        rows = history.time.size
        k, p, settings = np.ones(inputs), constants.parameters, constants.settings
        stages, work = np.zeros((5, states)), np.zeros(order + inputs * inputs)
        for i in range(rows):
            now = Reference(reference.chain[i], reference.derivative[i])
            truth = history.effectiveness[i]
            know(state, truth, constants, i)
            for j in range(inputs):
                k[j] = max(state.z[states + j], settings.floor)
            _record_knowledge(state, history, i)
            status = law(state.z[:states], state.u_n, k, p, now, constants.gain, work, state.u)
            if status != SOLVED:
                return status, i
            record(state, now, constants, history, i)
            for _ in range(settings.substeps):
                propagate(state.x, state.u, truth, p, settings.dt / settings.substeps, stages)
            for j in range(states):
                if not math.isfinite(state.x[j]):
                    return NOT_FINITE, i
            trim_step(state.u_n, state.u, settings.zeta, settings.dt)
        return SOLVED, rows - 1

    return run


def _make_know(kernels: Kernels, states: int, inputs: int) -> Callable[..., None]:
    estimate, observe = make_filter(kernels, states, inputs, inputs), kernels.outputs

    @compiled_in_memory
    def know(state: LoopState, truth: Any, constants: Constants, i: int) -> None:
        """State and effectiveness as the law is told them: estimated by (22)-(34), or the truth."""
        settings = constants.settings
        if not settings.adaptive:
            state.z[:states] = state.x
            state.z[states:] = truth
        elif i > 0:
            filter_settings = FilterSettings(
                settings.process_noise,
                settings.measurement_noise,
                settings.spread,
                settings.floor,
                settings.dt,
            )
            y = np.zeros(inputs)
            observe(state.x, constants.parameters, y)
            estimate(state.z, state.covariance, state.u, y, constants.parameters, filter_settings)

    return know


@compiled
def _record_knowledge(state: LoopState, history: History, i: int) -> None:
    """Write state, estimate and trim input of a sample, before the law."""
    history.state[i] = state.x
    history.estimate[i] = state.z
    history.trim[i] = state.u_n
    for j in range(state.z.size):
        history.deviation[i, j] = math.sqrt(max(state.covariance[j, j], 0.0))


def _make_record(kernels: Kernels, inputs: int, order: int) -> Callable[..., None]:
    chain, law_terms, m = kernels.chain, kernels.law_terms, inputs

    @compiled_in_memory
    def record(
        state: LoopState, now: Reference, constants: Constants, history: History, i: int
    ) -> None:
        """Write the command, E of (16), and y^(r) as it truly is minus what (18) counts on.

        The r-th derivative is that of the exact system: dL_f^(r-1) h/dx F(x, u, k), which the affine
        form gives at u_n = u, where its remainder is zero.
        """
        x, u, p, truth = state.x, state.u, constants.parameters, history.effectiveness[i]
        error, gain = history.error[i], constants.gain
        history.command[i] = u
        chain(x, truth, p, error)
        drift, matrix = np.zeros(m), np.zeros((m, m))
        law_terms(x, u, truth, p, drift, matrix)
        for a in range(order):
            error[a] -= now.chain[a]
        for a in range(m):
            total = drift[a] - now.derivative[a]
            for b in range(m):
                total += matrix[a, b] * u[b]
            for b in range(order):
                total += gain[a, b] * error[b]
            history.residual[i, a] = total

    return record
