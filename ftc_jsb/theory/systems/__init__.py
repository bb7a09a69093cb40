"""The systems that are shipped, and the flights of them that `ftc-jsb theory NAME` makes."""

from collections.abc import Callable

from ftc_jsb.theory.case import Case
from ftc_jsb.theory.systems.fighter import (
    fighter_by_position,
    fighter_by_velocity,
    fighter_case,
)
from ftc_jsb.theory.systems.levitator import levitator, levitator_case
from ftc_jsb.theory.systems.reactor import reactor, reactor_case
from ftc_jsb.theory.systems.textbook import textbook_case, textbook_plant
from ftc_jsb.theory.systems.vessel import vessel, vessel_case

__all__ = [
    "CASES",
    "fighter_by_position",
    "fighter_by_velocity",
    "levitator",
    "reactor",
    "textbook_plant",
    "vessel",
]

CASES: dict[str, Callable[[], Case]] = {
    "fighter": fighter_case,
    "levitator": levitator_case,
    "reactor": reactor_case,
    "textbook": textbook_case,
    "vessel": vessel_case,
}
