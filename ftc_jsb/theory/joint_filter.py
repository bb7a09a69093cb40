"""Joint estimation (20)-(34) of state and faults for any system, reduced form, nonlinear outputs too.

For nonlinear h the sigma points are drawn again from the predicted covariance, Q included, before
they go through h. The augmented form keeps the propagated points, so that for nonlinear h the two
differ at second order; `augmented.py` is that form, and docs/theory.md says by how much.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from ftc_jsb.compiled import compiled_in_memory
from ftc_jsb.estimation.cholesky import cholesky, cholesky_solve
from ftc_jsb.theory.generated import Kernels


def make_propagate(kernels: Kernels) -> Callable[..., None]:
    """`propagate(x, u, k, p, dt, scratch)`: one Runge-Kutta step of (2), in place.

    x (states,); u, k (inputs,); p (parameters,); scratch (5, states).
    """
    dynamics = kernels.dynamics

    @compiled_in_memory
    def propagate(x: Any, u: Any, k: Any, p: Any, dt: float, scratch: Any) -> None:
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


def make_filter(kernels: Kernels, states: int, faults: int, outputs: int) -> Callable[..., None]:
    """The compiled filter of a system over z = [x, k].

    The result is `step(z, cov, u, y, p, q, r, spread, floor, dt)`: prediction over a sample under a
    held u and correction by y, in place. z (states + faults,), cov its covariance; q, r the diagonals
    of Q and R; spread = n_a + kappa; floor bounds the fault states to [floor, 1], 0 = not at all.
    """
    observe = kernels.outputs
    propagate = make_propagate(kernels)
    n = states + faults
    m = outputs

    @compiled_in_memory
    def draw(z: Any, cov: Any, spread: float, factor: Any, points: Any) -> None:
        cholesky(cov, n, factor)
        scale = spread**0.5
        for i in range(n):
            points[0, i] = z[i]
            for j in range(n):
                points[1 + j, i] = z[i] + scale * factor[i, j]
                points[1 + n + j, i] = z[i] - scale * factor[i, j]

    @compiled_in_memory
    def step(
        z: Any,
        cov: Any,
        u: Any,
        y: Any,
        p: Any,
        q: Any,
        r: Any,
        spread: float,
        floor: float,
        dt: float,
    ) -> None:
        factor, points = np.zeros((n, n)), np.empty((2 * n + 1, n))
        scratch = np.empty((5, states))
        weight, centre = 0.5 / spread, 1.0 - n / spread  # (29)
        draw(z, cov, spread, factor, points)  # (26)
        for a in range(2 * n + 1):  # (27)
            propagate(points[a, :states], u, points[a, states:], p, dt, scratch)
        for i in range(n):  # (28)
            total = 0.0
            for a in range(1, 2 * n + 1):
                total += points[a, i] - points[0, i]
            z[i] = points[0, i] + weight * total
        for i in range(n):  # (30)
            for j in range(i + 1):
                total = centre * (points[0, i] - z[i]) * (points[0, j] - z[j])
                for a in range(1, 2 * n + 1):
                    total += weight * (points[a, i] - z[i]) * (points[a, j] - z[j])
                cov[i, j] = total
                cov[j, i] = total
            cov[i, i] += q[i]
        draw(z, cov, spread, factor, points)
        seen = np.empty((2 * n + 1, m))
        for a in range(2 * n + 1):  # (31)
            observe(points[a, :states], p, seen[a])
        mean = np.empty(m)
        for i in range(m):  # (32)
            total = 0.0
            for a in range(1, 2 * n + 1):
                total += seen[a, i] - seen[0, i]
            mean[i] = seen[0, i] + weight * total
        pyy, pxy = np.zeros((m, m)), np.zeros((n, m))
        for a in range(2 * n + 1):  # (33)
            share = centre if a == 0 else weight
            for i in range(m):
                for j in range(m):
                    pyy[i, j] += share * (seen[a, i] - mean[i]) * (seen[a, j] - mean[j])
                for j in range(n):
                    pxy[j, i] += share * (points[a, j] - z[j]) * (seen[a, i] - mean[i])
        for i in range(m):
            pyy[i, i] += r[i]
            if not np.isfinite(y[i]):
                return
        root, gain = np.zeros((m, m)), pxy.copy()
        cholesky(pyy, m, root)
        for j in range(n):
            cholesky_solve(root, m, gain[j])
        for j in range(n):  # (34)
            for i in range(m):
                z[j] += gain[j, i] * (y[i] - mean[i])
        for j in range(n):
            for k in range(j + 1):
                total = cov[j, k]
                for i in range(m):
                    total -= gain[j, i] * pxy[k, i]
                cov[j, k] = total
                cov[k, j] = total
        if floor > 0.0:
            for j in range(states, n):
                z[j] = min(max(z[j], floor), 1.0)

    return step
