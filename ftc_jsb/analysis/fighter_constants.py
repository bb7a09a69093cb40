"""Kernels and constants of the paper's fighter, kept on the disk: SymPy is imported once for a source."""

import pickle
from functools import cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.kernel_cache import kernels_of
from ftc_jsb.theory.constants import ProofConstants
from ftc_jsb.theory.generated import Kernels, generate, imported_kernels
from ftc_jsb.verified_cache import read_cached, write_cached

Array = npt.NDArray[np.float64]


class Fighter(NamedTuple):
    """What is known of the paper's fighter before any flight."""

    kernels: Kernels
    constants: ProofConstants
    low: Array  # (states + inputs,), the box of the constants
    high: Array


@cache
def fighter() -> Fighter:
    """Read from the disk, or made."""
    name = f"{kernels_of(__name__)}/fighter.pickle"
    payload = read_cached(name)
    if payload is None:
        return _made(name)
    package, parameters, constants, low, high = pickle.loads(payload)
    try:
        return Fighter(imported_kernels(package, parameters, parameters), constants, low, high)
    except ImportError:
        return _made(name)


def _made(name: str) -> Fighter:
    from ftc_jsb.theory.constants import proof_constants
    from ftc_jsb.theory.linearization import linearize
    from ftc_jsb.theory.proof import box
    from ftc_jsb.theory.systems import fighter_by_velocity

    linear = linearize(fighter_by_velocity())
    kernels, constants = generate(linear), proof_constants(linear)
    low, high = box(linear.system)
    write_cached(name, pickle.dumps((kernels.package, kernels.parameters, constants, low, high)))
    return Fighter(kernels, constants, low, high)
