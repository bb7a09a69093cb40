"""The discrete model (3), (21) of any system: a Runge-Kutta step of (2), for the plant and the filter."""

from collections.abc import Callable

from ftc_jsb.compiled import compiled_in_memory
from ftc_jsb.theory.generated import Kernels
from ftc_jsb.vocabulary.kernel_types import Matrix, Vector


def make_propagate(kernels: Kernels) -> Callable[..., None]:
    """`propagate(x, u, k, p, dt, scratch)`: one Runge-Kutta step of (2), in place.

    x (states,); u, k (inputs,); p (parameters,); dt [s]; scratch (5, states).
    """
    dynamics = kernels.dynamics

    @compiled_in_memory
    def propagate(x: Vector, u: Vector, k: Vector, p: Vector, dt: float, scratch: Matrix) -> None:
        n = x.size
        k1, k2, k3, k4, y = scratch[0], scratch[1], scratch[2], scratch[3], scratch[4]
        dynamics(x, u, k, p, k1)
        for i in range(n):
            y[i] = x[i] + 0.5 * dt * k1[i]
        dynamics(y, u, k, p, k2)
        for i in range(n):
            y[i] = x[i] + 0.5 * dt * k2[i]
        dynamics(y, u, k, p, k3)
        for i in range(n):
            y[i] = x[i] + dt * k3[i]
        dynamics(y, u, k, p, k4)
        for i in range(n):
            x[i] += dt / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i])

    return propagate
