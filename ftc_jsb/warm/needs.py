"""Which kernels a flight needs: those of its model, and those of isolation where its loop isolates."""

from collections.abc import Iterable
from typing import NamedTuple

from ftc_jsb.scenario.loop import Loop

POINT_MASS, JSBSIM, ISOLATING = "point-mass", "jsbsim", "isolating"
EVERYTHING = (POINT_MASS, JSBSIM, ISOLATING)


class Flown(NamedTuple):
    """What decides which kernels a flight needs."""

    model: str
    loop: Loop


def needs(flights: Iterable[Flown]) -> tuple[str, ...]:
    """Which of EVERYTHING the flights need, in its order."""
    from ftc_jsb.loops.built_in import BUILT_IN, isolates

    found = set()
    for model, loop in flights:
        if model in ("paper", "identified"):
            found.add(POINT_MASS)
        elif loop.name in BUILT_IN and isolates(loop):
            found.add(ISOLATING)
        else:
            found.add(JSBSIM)
    return tuple(need for need in EVERYTHING if need in found)
