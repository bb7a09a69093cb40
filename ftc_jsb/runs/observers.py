"""Who watches a flight that a command flies: made anew for each flight, by its label."""

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager

from ftc_jsb.simulation.fly import Observer

ObserverFactory = Callable[[str], AbstractContextManager[Sequence[Observer]]]
