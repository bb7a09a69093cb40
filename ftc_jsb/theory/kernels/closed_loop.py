"""A sample of the closed loop (35), (36) after another: sensors, joint estimate, law, limits, plant."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled
from ftc_jsb.theory.trim_filter import trim_step
from ftc_jsb.vocabulary.kernel_types import Vector

from .arrays import copy, fill
from .discrete_model import propagate
from .joint_filter import SOUND, FilterSettings, effectiveness_of, estimate
from .law import SCRATCH, SOLVED, Reference, Tuning, law
from .system import INPUTS, MEASURED, PLANT_STATES, STATES, plant_chain, plant_outputs

Array = npt.NDArray[np.float64]
NOT_FINITE = 1000  # status of a flight whose state left the finite numbers
FILTER_FAILED = 2000  # plus what the filter returned
ESTIMATE, TRUTH, HEALTHY = 0, 1, 2  # what the law is told: x^ and k^; x and k; x^ and k = 1


class World(NamedTuple):
    """What acts on plant and sensors, a row for each sample."""

    effectiveness: Array  # (rows, inputs), k
    told: Array  # (rows, inputs), k as a law with TRUTH knows it
    offset: Array  # (rows, inputs), added to k u
    held: Array  # (rows, inputs), where an input is stuck; nan = free
    push: Array  # (rows, plant states), added to the state after the sample: process noise
    sensor: Array  # (rows, measured), added to what is measured: noise, faults; nan = lost


class Actuators(NamedTuple):
    """Between command and efficacious input."""

    low: Array  # (inputs,)
    high: Array  # (inputs,)
    rate: Array  # (inputs,), largest change of the command [1/s]
    lag: Array  # (inputs,), time constant [s]; 0 = none


class Constants(NamedTuple):
    """What is constant over a flight."""

    tuning: Tuning
    filter: FilterSettings
    actuators: Actuators
    parameters: Array  # of the model
    plant_parameters: Array
    zeta: float  # of (10) [1/s]
    told: int  # ESTIMATE, TRUTH or HEALTHY
    substeps: int  # Runge-Kutta steps of the plant a sample


class History(NamedTuple):
    """What was flown, a row for each sample."""

    time: Array  # (rows,)
    state: Array  # (rows, plant states)
    measured: Array  # (rows, measured)
    estimate: Array  # (rows, states + faults), z of (20)
    deviation: Array  # (rows, states + faults)
    known: Array  # (rows, states + inputs), what the law was told
    effectiveness: Array  # (rows, inputs), the truth
    wanted: Array  # (rows, inputs), command of the law, before any limit
    command: Array  # (rows, inputs)
    delivered: Array  # (rows, inputs), efficacious input at the start of the sample
    trim: Array  # (rows, inputs), u_n
    error: Array  # (rows, order), e of (16) of the plant's own outputs
    reference: Array  # (rows, order), Y_m
    derivative: Array  # (rows, outputs), y_m^(r)


class LoopState(NamedTuple):
    """What changes from sample to sample, in place."""

    x: Array  # (plant states,), the true state
    z: Array  # (states + faults,), the joint estimate of (20)
    covariance: Array  # (states + faults, states + faults), of the estimate
    u_n: Array  # (inputs,), trim input of (10)
    u: Array  # (inputs,), command
    actuator: Array  # (inputs,), behind its lag


@compiled
def run(state: LoopState, world: World, constants: Constants, history: History) -> tuple[int, int]:
    """A flight in one call, along the reference that `history` holds.

    Returns:
        SOLVED, NOT_FINITE, FILTER_FAILED plus the filter's status, or what the law returned; and the
        row where it came to be.
    """
    rows, last = history.time.size, np.empty(INPUTS)
    known, scratch, k = np.ones(STATES + INPUTS), np.zeros(SCRATCH), np.ones(INPUTS)
    for i in range(rows):
        copy(state.u, last)
        status = _know(state, world, constants, history, i)
        if status != SOUND:
            return FILTER_FAILED + status, i
        _tell(state, world.told[i], constants, known)
        for j in range(INPUTS):
            k[j] = max(known[STATES + j], constants.filter.floor)
        now = Reference(history.reference[i], history.derivative[i])
        status = law(
            known[:STATES],
            state.u_n,
            k,
            constants.parameters,
            now,
            constants.tuning,
            scratch,
            state.u,
        )
        if status != SOLVED:
            return status, i
        _limit(state.u, last, i, constants, history.wanted[i])
        _record(state, known, history, constants, i)
        _move(state, world, constants, history.delivered[i], i)
        for j in range(PLANT_STATES):
            if not math.isfinite(state.x[j]):
                return NOT_FINITE, i
        trim_step(state.u_n, state.u, constants.zeta, constants.filter.dt)
    return SOLVED, rows - 1


@compiled
def _know(state: LoopState, world: World, constants: Constants, history: History, i: int) -> int:
    """Measure, and estimate by (22)-(34); state, trim input and estimate of the sample are written."""
    y, status = history.measured[i], SOUND
    plant_outputs(state.x, constants.plant_parameters, y)
    for j in range(MEASURED):
        y[j] += world.sensor[i, j]
    if i > 0:
        status = estimate(
            state.z, state.covariance, state.u, y, constants.parameters, constants.filter
        )
    copy(state.x, history.state[i])
    copy(state.z, history.estimate[i])
    copy(state.u_n, history.trim[i])
    for j in range(state.z.size):
        history.deviation[i, j] = math.sqrt(max(state.covariance[j, j], 0.0))
    return status


@compiled
def _tell(state: LoopState, told: Vector, constants: Constants, known: Vector) -> None:
    """State and effectiveness that the law goes by."""
    fill(known[STATES:], 1.0)
    if constants.told == TRUTH:
        copy(state.x[:STATES], known)
        copy(told, known[STATES:])
    else:
        copy(state.z[:STATES], known)
        if constants.told == ESTIMATE:
            effectiveness_of(state.z, known[STATES:])


@compiled
def _limit(u: Vector, last: Vector, i: int, constants: Constants, wanted: Vector) -> None:
    """Hold a command within its limits, and from the second sample on within its rate."""
    limits, step = constants.actuators, constants.filter.dt
    for j in range(INPUTS):
        wanted[j] = u[j]
        if i > 0:
            most = limits.rate[j] * step
            u[j] = min(max(u[j], last[j] - most), last[j] + most)
        u[j] = min(max(u[j], limits.low[j]), limits.high[j])


@compiled
def _move(state: LoopState, world: World, constants: Constants, delivered: Vector, i: int) -> None:
    """The plant over a sample: actuator, fault, Runge-Kutta steps of (2), process noise."""
    steps, scratch = constants.substeps, np.zeros((5, PLANT_STATES))
    dt, one, efficacious = constants.filter.dt / steps, np.ones(INPUTS), np.empty(INPUTS)
    for step in range(steps):
        for j in range(INPUTS):
            lag = constants.actuators.lag[j]
            share = 1.0 - math.exp(-dt / lag) if lag > 0.0 else 1.0
            state.actuator[j] += share * (state.u[j] - state.actuator[j])
            efficacious[j] = world.effectiveness[i, j] * state.actuator[j] + world.offset[i, j]
            if not math.isnan(world.held[i, j]):
                efficacious[j] = world.held[i, j]
        if step == 0:
            copy(efficacious, delivered)
        propagate(True, state.x, efficacious, one, constants.plant_parameters, dt, scratch)
    for j in range(PLANT_STATES):
        state.x[j] += world.push[i, j]


@compiled
def _record(
    state: LoopState, known: Vector, history: History, constants: Constants, i: int
) -> None:
    """Write command, knowledge and E of (16), that of the plant's own outputs."""
    copy(state.u, history.command[i])
    copy(known, history.known[i])
    error, one = history.error[i], np.ones(INPUTS)
    plant_chain(state.x, one, constants.plant_parameters, error)
    for j in range(error.size):
        error[j] -= history.reference[i, j]
