"""Kernels and constants of the paper's fighter, kept on the disk: SymPy is imported once for a source."""

import pickle
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import kernel_cache
from ftc_jsb.theory.constants import ProofConstants
from ftc_jsb.theory.generated import Kernels, generate, imported_kernels

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
    path = kernel_cache(__name__) / "fighter.pickle"
    try:
        package, parameters, constants, low, high = pickle.loads(path.read_bytes())
        return Fighter(imported_kernels(package, parameters, parameters), constants, low, high)
    except (OSError, ValueError, EOFError, ImportError):
        return _made(path)


def _made(path: Path) -> Fighter:
    from ftc_jsb.theory.constants import proof_constants
    from ftc_jsb.theory.linearization import linearize
    from ftc_jsb.theory.proof import box
    from ftc_jsb.theory.systems import fighter_by_velocity

    linear = linearize(fighter_by_velocity())
    kernels, constants = generate(linear), proof_constants(linear)
    low, high = box(linear.system)
    part = path.with_suffix(".part")
    part.write_bytes(pickle.dumps((kernels.package, kernels.parameters, constants, low, high)))
    part.replace(path)
    return Fighter(kernels, constants, low, high)
