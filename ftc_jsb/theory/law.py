"""The law (17)/(20) for any system and any indices, made from generated kernels."""

from collections.abc import Callable
from typing import Any

import numpy as np

from ftc_jsb.compiled import compiled, compiled_in_memory
from ftc_jsb.theory.generated import Kernels
from ftc_jsb.theory.solve import solve_in_place

SOLVED = -1


def make_law(kernels: Kernels) -> Callable[..., int]:
    """The compiled law of a system.

    The result is `law(x, u_n, k, p, wanted, gain, reference, scratch, u) -> status`:

    - x (states,), u_n (inputs,), k (inputs,), p (parameters,): state or estimate, trim input of
      (10), effectiveness, parameters;
    - wanted (outputs,): y_m^(r) of (17);
    - gain (outputs, order): K; reference (order,): Y_m of (16);
    - scratch (2 order + outputs^2,): working space;
    - u (inputs,): receives the command, before any limit;
    - status: -1, or the number of the input for which G of (14) has no pivot at this point.
    """
    chain, law_terms = kernels.chain, kernels.law_terms

    @compiled_in_memory
    def law(
        x: Any,
        u_n: Any,
        k: Any,
        p: Any,
        wanted: Any,
        gain: Any,
        reference: Any,
        scratch: Any,
        u: Any,
    ) -> int:
        order, count = reference.size, wanted.size
        outputs = scratch[:order]
        chain(x, k, p, outputs)
        matrix = scratch[2 * order : 2 * order + count * count].reshape((count, count))
        law_terms(x, u_n, k, p, u, matrix)
        for i in range(count):
            total = wanted[i] - u[i]  # u holds script F here
            for j in range(order):
                total -= gain[i, j] * (outputs[j] - reference[j])  # e of (16), the sign of (18)
            u[i] = total
        return solve_in_place(matrix, u)

    return law


@compiled
def trim_step(u_n: Any, u: Any, zeta: float, dt: float) -> None:
    """(10) over a sample with the command held: u_n += (1 - exp(-zeta dt)) (u - u_n)."""
    share = 1.0 - np.exp(-zeta * dt)
    for i in range(u_n.size):
        u_n[i] += share * (u[i] - u_n[i])


@compiled
def trim_step_second_order(u_n: Any, rate: Any, u: Any, zeta: float, dt: float) -> None:
    """The higher-order filter that Remark 5 allows, in place of (10).

    Critically damped, u_n'' = zeta^2 (u - u_n) - 2 zeta u_n', exact for held commands; it gives the
    rate of u_n as well, with the same lag 2 / zeta that two filters (10) in a row would have.
    """
    decay = np.exp(-zeta * dt)
    for i in range(u_n.size):
        away = u_n[i] - u[i]
        slope = rate[i] + zeta * away
        u_n[i] = u[i] + (away + slope * dt) * decay
        rate[i] = (slope - zeta * (away + slope * dt)) * decay
