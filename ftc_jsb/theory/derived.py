"""What follows from a system alone, kept on the disk: derivatives, bounds, constants, generated kernels.

Gains, references, noise and faults are no part of it: a case whose settings change is flown at once.
"""

import hashlib
import pickle
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
import sympy as sp

from ftc_jsb.kernel_cache import kernels_of
from ftc_jsb.theory.bounds import Bounds, bounds
from ftc_jsb.theory.constants import ProofConstants, proof_constants
from ftc_jsb.theory.generated import Kernels, generate, imported_kernels
from ftc_jsb.theory.linearization import Linearization, linearize
from ftc_jsb.theory.system import System
from ftc_jsb.verified_cache import read_cached, write_cached


class Derived(NamedTuple):
    """Of a system, and of the plant that is flown in its place."""

    linearization: Linearization
    bounds: Bounds
    constants: ProofConstants
    kernels: Kernels


def derive(system: System, plant: System | None = None) -> Derived:
    """Read from the disk, or made and kept there.

    Args:
        system: of law and filter.
        plant: what is flown, if not that system.

    Raises:
        TheoryError: the theory does not cover the system, or the plant does not fit it.
    """
    name = _name(system, plant)
    payload = read_cached(name)
    if payload is not None:
        linear, found, constants, kernels = pickle.loads(payload)
        try:
            return Derived(linear, found, constants, imported_kernels(*kernels))
        except ImportError:  # the generated sources are gone
            pass
    linear = linearize(system)
    made = Derived(linear, bounds(system), proof_constants(linear), generate(linear, plant))
    kept = (made.kernels.package, made.kernels.parameters, made.kernels.plant_parameters)
    write_cached(name, pickle.dumps((linear, made.bounds, made.constants, kept)))
    return made


def _name(system: System, plant: System | None) -> str:
    """Below the cache: all that a derivation is made from is in it."""
    made_from = f"{sp.__version__} {np.__version__} {_text(system)} {plant and _text(plant)}"
    digest = hashlib.sha256(made_from.encode()).hexdigest()[:16]
    return f"{kernels_of(__name__)}/{digest}.system"


def _text(system: System) -> str:
    """The same for equal systems, in every process."""
    mappings = (system.parameters, system.ranges)
    named = [sorted((sp.srepr(key), repr(value)) for key, value in m.items()) for m in mappings]
    parts: list[Iterable[sp.Basic]] = [system.states, system.inputs, system.parameters]
    parts += [system.dynamics, system.outputs, system.measured, system.fallible]
    exact = [[sp.srepr(sp.sympify(element)) for element in part] for part in parts]
    return repr((system.name, exact, named))
