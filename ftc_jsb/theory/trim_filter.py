"""The trim input u_n: filter (10) of the command, and one of second order that Remark 5 allows."""

import numpy as np

from ftc_jsb.compiled import compiled
from ftc_jsb.vocabulary.kernel_types import Vector


@compiled
def trim_step(u_n: Vector, u: Vector, zeta: float, dt: float) -> None:
    """(10) over a sample with the command held: u_n += (1 - exp(-zeta dt)) (u - u_n).

    Args:
        u_n: (inputs,), changed in place.
        u: (inputs,), the command.
        zeta: of (10) [1/s].
        dt: sample time [s].
    """
    share = 1.0 - np.exp(-zeta * dt)
    for i in range(u_n.size):
        u_n[i] += share * (u[i] - u_n[i])


@compiled
def trim_step_second_order(u_n: Vector, rate: Vector, u: Vector, zeta: float, dt: float) -> None:
    """The higher-order filter that Remark 5 allows, in place of (10).

    Critically damped, u_n'' = zeta^2 (u - u_n) - 2 zeta u_n', exact for held commands; it gives the
    rate of u_n as well, with the same lag 2 / zeta that two filters (10) in a row would have.

    Args:
        u_n, rate: (inputs,), and its rate a second, both changed in place.
        u: (inputs,), the command.
        zeta: [1/s].
        dt: sample time [s].
    """
    decay = np.exp(-zeta * dt)
    for i in range(u_n.size):
        away = u_n[i] - u[i]
        slope = rate[i] + zeta * away
        u_n[i] = u[i] + (away + slope * dt) * decay
        rate[i] = (slope - zeta * (away + slope * dt)) * decay
