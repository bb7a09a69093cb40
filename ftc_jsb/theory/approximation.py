"""The affine approximation (4)-(6) at the trim input, its remainder (7) and its bounds (8)-(9)."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import sympy as sp

from ftc_jsb.theory.system import Symbols, System

Array = npt.NDArray[np.float64]


class Approximation(NamedTuple):
    """x' = f(x, u_n, k) + g(x, u_n, k) u + O(.): (4)-(6)."""

    trim: Symbols  # u_n
    f: sp.Matrix  # (states, 1)
    g: sp.Matrix  # (states, inputs)
    remainder: sp.Matrix  # (7) as printed, (states, 1)


def approximate(system: System) -> Approximation:
    """(4)-(6): g = dF/du at u_n, f = F(x, u_n, k) - g u_n; the leftover E(x) d of (6) is dropped."""
    trim = tuple(sp.Symbol(f"{symbol.name}_n", real=True) for symbol in system.inputs)
    at_trim = dict(zip(system.inputs, trim, strict=True))
    faulty = system.faulty_dynamics
    g = faulty.jacobian(list(system.inputs)).subs(at_trim, simultaneous=True)
    at = faulty.subs(at_trim, simultaneous=True)
    step = sp.Matrix(system.inputs) - sp.Matrix(trim)
    return Approximation(trim, at - g * sp.Matrix(trim), g, faulty - at - g * step)


class Bounds(NamedTuple):
    """Constants of Assumption 2 and Proposition 4, estimated over a set: lower bounds of the true ones."""

    lipschitz: float  # L_1 of (8)
    gain: float  # g_M of Assumption 2
    remainder: float  # L_2 = L_1 + g_M of (9)
    remainder_found: float  # the largest ||O|| / ||u - u_n|| that was met; at most L_2


def estimate_bounds(
    dynamics: Callable[[Array, Array], Array],
    gain: Callable[[Array, Array], Array],
    low: Array,
    high: Array,
    inputs: int,
    samples: int = 4096,
    seed: int = 0,
) -> Bounds:
    """L_1, g_M and L_2 of (8)-(9) over a box of states and inputs, from a Sobol sequence.

    Args:
        dynamics: F(x, u), (states,).
        gain: g(x, u_n), (states, inputs).
        low, high: (states + inputs,), corners of the box; u and u_n are both drawn from it.
        inputs: m.
        samples: pairs (u, u_n), a power of two.
        seed: of the sequence's scrambling.
    """
    from scipy.stats import qmc

    states = len(low) - inputs
    unit = qmc.Sobol(len(low) + inputs, seed=seed).random(samples)
    lipschitz = largest_gain = found = 0.0
    for row in unit:
        point = low + row[: len(low)] * (high - low)
        x, u = point[:states], point[states:]
        trim = low[states:] + row[len(low) :] * (high - low)[states:]
        distance = float(np.linalg.norm(u - trim))
        if distance < 1e-9:
            continue
        difference = dynamics(x, u) - dynamics(x, trim)
        g = gain(x, trim)
        lipschitz = max(lipschitz, float(np.linalg.norm(difference)) / distance)
        largest_gain = max(largest_gain, float(np.linalg.norm(g, 2)))
        remainder = difference - g @ (u - trim)
        found = max(found, float(np.linalg.norm(remainder)) / distance)
    return Bounds(lipschitz, largest_gain, lipschitz + largest_gain, found)
