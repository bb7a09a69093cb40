"""The law (17)/(20) for any system and any indices, made from generated kernels."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled_in_memory
from ftc_jsb.theory.elimination import solve_in_place
from ftc_jsb.theory.generated import Kernels
from ftc_jsb.vocabulary.kernel_types import Matrix, Vector

SOLVED = -1


class Reference(NamedTuple):
    """What is to be tracked, at one time; along a flight each has a row for each sample."""

    chain: npt.NDArray[np.float64]  # (order,), Y_m of (16)
    derivative: npt.NDArray[np.float64]  # (outputs,), y_m^(r) of (17)


def make_law(kernels: Kernels) -> Callable[..., int]:
    """The compiled law of a system.

    The result is `law(x, u_n, k, p, reference, gain, scratch, u) -> status`:

    - x (states,), u_n (inputs,), k (inputs,), p (parameters,): state or estimate, trim input of
      (10), effectiveness, parameters;
    - reference: a `Reference`; gain (outputs, order): K of (17);
    - scratch (>= order + outputs^2,): working space;
    - u (inputs,): receives the command, before any limit;
    - status: -1, or the number of the input for which G of (14) has no pivot at this point.
    """
    chain, law_terms = kernels.chain, kernels.law_terms

    @compiled_in_memory
    def law(
        x: Vector,
        u_n: Vector,
        k: Vector,
        p: Vector,
        reference: Reference,
        gain: Matrix,
        scratch: Vector,
        u: Vector,
    ) -> int:
        order, count = reference.chain.size, reference.derivative.size
        outputs = scratch[:order]
        chain(x, k, p, outputs)
        matrix = scratch[order : order + count * count].reshape((count, count))
        law_terms(x, u_n, k, p, u, matrix)
        for i in range(count):
            total = reference.derivative[i] - u[i]  # u holds script F here
            for j in range(order):
                error = outputs[j] - reference.chain[j]  # e of (16), the sign of (18)
                total -= gain[i, j] * error
            u[i] = total
        return solve_in_place(matrix, u)

    return law
