"""Constants of the proof over the ranges of a system, component by component, known before any flight."""

from functools import cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import sympy as sp

from ftc_jsb.theory.bounds import box_of
from ftc_jsb.theory.enclosure import Enclosure, largest
from ftc_jsb.theory.linearization import Linearization

Array = npt.NDArray[np.float64]


class ProofConstants(NamedTuple):
    """Upper ends of suprema over the ranges; no norm adds m/s to rad."""

    sensitivity: Array  # (outputs, states + inputs): |d y_i^(r) / d [x, k]_j|, the P of (35)
    chain: Array  # (order, states): |d chain / d x|
    curvature: Array  # (outputs, inputs, inputs): |d2 y_i^(r) / du_j du_l|
    drift: Array  # (outputs,): |d y_i^(r) / dx F|, change while a command is held
    certified: bool  # whether every one is proven


def proof_constants(linearization: Linearization) -> ProofConstants:
    """Enclose each element over the box of states, inputs and factors."""
    system = linearization.system
    box, highest = box_of(system), linearization.highest
    states, inputs, factors = map(list, (system.states, system.inputs, system.effectiveness))
    found: list[Enclosure] = []

    @cache
    def most(element: sp.Expr) -> float:  # of a Hessian each but the diagonal comes twice
        if element == 0:
            return 0.0
        enclosure = largest(sp.Matrix([[element]]), box)
        found.append(enclosure)
        return enclosure.most if enclosure.certified else enclosure.least

    def each(matrix: sp.Matrix) -> Array:
        return np.array([[most(element) for element in row] for row in matrix.tolist()], float)

    hessians = [sp.hessian(element, inputs) for element in highest]
    drift = highest.jacobian(states) * system.faulty_dynamics
    return ProofConstants(
        each(highest.jacobian(states + factors)),
        each(linearization.chain.jacobian(states)),
        np.array([each(hessian) for hessian in hessians]),
        each(drift)[:, 0],
        all(enclosure.certified for enclosure in found),
    )
