"""The discrete model (3), (21): a Runge-Kutta step of (2), of the model and of the plant."""

from ftc_jsb.compiled import compiled
from ftc_jsb.vocabulary.kernel_types import Matrix, Vector

from .system import dynamics, plant_dynamics


@compiled
def rates(plant: bool, x: Vector, u: Vector, k: Vector, p: Vector, out: Vector) -> None:
    """F of the plant or of the model."""
    if plant:
        plant_dynamics(x, u, k, p, out)
    else:
        dynamics(x, u, k, p, out)


@compiled
def propagate(
    plant: bool, x: Vector, u: Vector, k: Vector, p: Vector, dt: float, scratch: Matrix
) -> None:
    """One classical Runge-Kutta step of (2), in place.

    Args:
        plant: whether of the plant; of the filter's model otherwise.
        x: (states,).
        u, k: (inputs,).
        p: (parameters,).
        dt: [s].
        scratch: (5, states).
    """
    n = x.size
    k1, k2, k3, k4, y = scratch[0], scratch[1], scratch[2], scratch[3], scratch[4]
    rates(plant, x, u, k, p, k1)
    for i in range(n):
        y[i] = x[i] + 0.5 * dt * k1[i]
    rates(plant, y, u, k, p, k2)
    for i in range(n):
        y[i] = x[i] + 0.5 * dt * k2[i]
    rates(plant, y, u, k, p, k3)
    for i in range(n):
        y[i] = x[i] + dt * k3[i]
    rates(plant, y, u, k, p, k4)
    for i in range(n):
        x[i] += dt / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i])
