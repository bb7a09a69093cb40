"""The law (17)/(20) for any indices, and its allocation where there are more inputs than outputs."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled
from ftc_jsb.theory.elimination import solve_in_place
from ftc_jsb.vocabulary.kernel_types import Matrix, Vector

from .system import INPUTS, ORDER, OUTPUTS, chain, law_terms

Array = npt.NDArray[np.float64]
SOLVED = -1
REACH = 1e6  # a step of an input that is larger than this times its scale: G says nothing there
SCRATCH = ORDER + OUTPUTS + OUTPUTS * INPUTS + OUTPUTS * OUTPUTS


class Reference(NamedTuple):
    """What is to be tracked, at one time; along a flight each has a row for each sample."""

    chain: Array  # (order,), Y_m of (16)
    derivative: Array  # (outputs,), y_m^(r) of (17)


class Tuning(NamedTuple):
    """What is constant in the law."""

    gain: Array  # (outputs, order), K of (17)
    scale: Array  # (inputs,), size of each input; also the weight of an allocation
    preferred: Array  # (inputs,), where an allocation would have the inputs


@compiled
def law(
    x: Vector,
    u_n: Vector,
    k: Vector,
    p: Vector,
    reference: Reference,
    tuning: Tuning,
    scratch: Vector,
    u: Vector,
) -> int:
    """(20): u = G^-1 [-F + y_m^(r) - K e], before any limit.

    Args:
        x: (states,), state or estimate.
        u_n: (inputs,), trim input of (10).
        k: (inputs,), effectiveness or its estimate.
        p: (parameters,).
        reference: at this time.
        tuning: K, and the sizes of the inputs.
        scratch: (>= SCRATCH,).
        u: (inputs,), receives the command.

    Returns:
        SOLVED, or the number of the input (with an allocation: output) for which G of (14) has no
        pivot, or of an input that would have to step by more than REACH times its scale.
    """
    errors, demand = scratch[:ORDER], scratch[ORDER : ORDER + OUTPUTS]
    start = ORDER + OUTPUTS
    matrix = scratch[start : start + OUTPUTS * INPUTS].reshape((OUTPUTS, INPUTS))
    chain(x, k, p, errors)
    law_terms(x, u_n, k, p, demand, matrix)
    for i in range(OUTPUTS):
        total = reference.derivative[i] - demand[i]  # demand holds script F here
        for j in range(ORDER):
            error = errors[j] - reference.chain[j]  # e of (16), the sign of (18)
            total -= tuning.gain[i, j] * error
        demand[i] = total
    if OUTPUTS == INPUTS:
        for i in range(OUTPUTS):
            u[i] = demand[i]
        status = solve_in_place(matrix, u)
    else:
        square = scratch[start + OUTPUTS * INPUTS : SCRATCH].reshape((OUTPUTS, OUTPUTS))
        status = allocate(matrix, demand, square, tuning, u)
    if status != SOLVED:
        return status
    for j in range(INPUTS):
        if not abs(u[j] - u_n[j]) <= REACH * tuning.scale[j]:
            return j
    return SOLVED


@compiled
def allocate(matrix: Matrix, demand: Vector, square: Matrix, tuning: Tuning, u: Vector) -> int:
    """The least weighted departure from the preferred inputs that does what is demanded.

    u = u_p + W G^T (G W G^T)^-1 (demand - G u_p), W = diag(scale^2).

    Args:
        matrix: G, (outputs, inputs).
        demand: (outputs,), overwritten.
        square: (outputs, outputs), working space.
        tuning: u_p and scale.
        u: (inputs,), receives the command.

    Returns:
        SOLVED, or the output for which G has no full row rank.
    """
    for i in range(OUTPUTS):
        for j in range(INPUTS):
            demand[i] -= matrix[i, j] * tuning.preferred[j]
        for a in range(OUTPUTS):
            total = 0.0
            for j in range(INPUTS):
                total += matrix[i, j] * tuning.scale[j] ** 2 * matrix[a, j]
            square[i, a] = total
    status = solve_in_place(square, demand)
    if status != SOLVED:
        return status
    for j in range(INPUTS):
        total = 0.0
        for i in range(OUTPUTS):
            total += matrix[i, j] * demand[i]
        u[j] = tuning.preferred[j] + tuning.scale[j] ** 2 * total
    return SOLVED
