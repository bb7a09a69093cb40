"""Lines of the exchange as text: formed, read, and refused where they are not what they should be.

A line is its fields as decimal numbers, separated by commas, then the check, which is the sum of every field
times its place (from 1), and a newline.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

LONGEST = 4096  # characters of a line
TOLERANCE = 1e-6  # of the check, and
ROUNDING = 1e-15  # of its largest term: numbers come with 17 digits


def check_of(numbers: Sequence[float]) -> float:
    """Sum of the numbers times their places, added in their order."""
    return sum((place * number for place, number in enumerate(numbers, 1)), 0.0)


def line_of(numbers: Sequence[float]) -> bytes:
    """A line.

    Raises:
        ValueError: one is not finite.
    """
    if not all(map(math.isfinite, numbers)):
        raise ValueError("a line holds finite numbers")
    return (",".join(map(repr, [*map(float, numbers), check_of(numbers)])) + "\n").encode("ascii")


def numbers_of(line: bytes, count: int) -> tuple[float, ...] | None:
    """Numbers of a line whose check is right; None of any other.

    Args:
        line: as it came, from anybody.
        count: of the numbers, `check` apart.
    """
    if len(line) > LONGEST:
        return None
    try:
        numbers = [float(part) for part in line.decode("ascii").strip().split(",")]
    except ValueError:
        return None
    if len(numbers) != count + 1 or not all(map(math.isfinite, numbers)):
        return None
    *fields, check = numbers
    largest = max(abs(place * number) for place, number in enumerate(fields, 1))
    if abs(check_of(fields) - check) > TOLERANCE + ROUNDING * largest:
        return None
    return tuple(fields)


class Counts(NamedTuple):
    """What became of the lines that came."""

    taken: int = 0
    repeated: int = 0  # of the same frame: doubled, or sent while time stood still
    disordered: int = 0  # of an earlier frame
    malformed: int = 0
    surplus: int = 0  # sooner than the loop's rate asks for

    def __str__(self) -> str:
        return ", ".join(f"{number} {name}" for name, number in self._asdict().items())
