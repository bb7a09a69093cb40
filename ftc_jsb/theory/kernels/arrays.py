"""Assignments of whole arrays as loops: Numba takes seconds to compile a slice that is assigned to."""

from ftc_jsb.compiled import compiled
from ftc_jsb.vocabulary.kernel_types import Vector


@compiled
def copy(source: Vector, target: Vector) -> None:
    """Write each element of `source` to `target`."""
    for i in range(source.size):
        target[i] = source[i]


@compiled
def fill(target: Vector, value: float) -> None:
    """Set every element."""
    for i in range(target.size):
        target[i] = value
