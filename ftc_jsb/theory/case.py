"""A system with all it takes to analyse and to fly it: references and faults as expressions of time."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
import sympy as sp

from ftc_jsb.errors import TheoryError
from ftc_jsb.theory.closed_loop import NOTHING_ELSE, Conditions, Settings
from ftc_jsb.theory.gains import Gains, decaying_gains
from ftc_jsb.theory.linearization import Linearization
from ftc_jsb.theory.proof import Task
from ftc_jsb.theory.system import Expressions, System

Array = npt.NDArray[np.float64]
TIME = sp.Symbol("t", real=True)
SHARE = 0.8  # of the slowest pole: at which V of the proof decays


@dataclass(frozen=True)
class Case:
    """What `ftc-jsb theory` takes; a file of the user's own has one under the name CASE."""

    title: str
    system: System
    poles: tuple[tuple[float, ...], ...]  # of the error of each output, as many as its index
    reference: Expressions  # y_m of each output, of TIME; as smooth as its index asks for
    initial: tuple[float, ...]  # state
    trim: tuple[float, ...]  # u_n(0)
    duration: float
    settings: Settings
    effectiveness: Mapping[sp.Symbol, sp.Expr] = field(default_factory=dict)  # k, of TIME; else 1
    conditions: Conditions = NOTHING_ELSE
    plant: System | None = None  # what is flown, if not the system itself
    time_unit: str = "s"

    def __post_init__(self) -> None:
        """Check the sizes.

        Raises:
            TheoryError: one that does not fit the system.
        """
        system = self.system
        for name, found, expected in (
            ("poles", len(self.poles), len(system.outputs)),
            ("reference", len(self.reference), len(system.outputs)),
            ("initial", len(self.initial), len(system.states)),
            ("trim", len(self.trim), len(system.inputs)),
            (
                "settings.process_noise",
                len(self.settings.process_noise),
                len(system.states) + len(system.fallible),
            ),
            (
                "settings.initial_covariance",
                len(self.settings.initial_covariance),
                len(system.states) + len(system.fallible),
            ),
            (
                "settings.measurement_noise",
                len(self.settings.measurement_noise),
                len(system.measured),
            ),
        ):
            if found != expected:
                raise TheoryError(
                    f"case {self.title!r}: {name} has {found} elements, expected {expected}"
                )
        for symbol in self.effectiveness:
            if symbol not in system.inputs:
                raise TheoryError(
                    f"case {self.title!r}: effectiveness of {symbol}, which is no input"
                )
        for expression in (*self.reference, *self.effectiveness.values()):
            unknown = sp.sympify(expression).free_symbols - {TIME}
            if unknown:
                raise TheoryError(
                    f"case {self.title!r}: {expression} has symbols other than time, ftc_jsb.theory.case.TIME"
                )

    def gains(self, linearization: Linearization) -> Gains:
        """K whose error dynamics have the poles.

        Raises:
            TheoryError: poles of another number than the index, or not in the left half plane.
        """
        a, b, _ = linearization.brunovsky()
        k, start = np.zeros((len(self.poles), linearization.order)), 0
        for row, (poles, index) in enumerate(zip(self.poles, linearization.index, strict=True)):
            if len(poles) != index:
                raise TheoryError(
                    f"case {self.title!r}: {len(poles)} poles for output {row}, whose index is {index}"
                )
            k[row, start : start + index] = np.poly(poles)[:0:-1]
            start += index
        slowest = -max(max(poles) for poles in self.poles)
        return decaying_gains(a, b, k, SHARE * slowest)

    def task(self, linearization: Linearization) -> Task:
        """What is flown."""
        lost = [self.effectiveness.get(symbol, sp.Integer(1)) for symbol in self.system.inputs]
        factors = sp.lambdify(TIME, lost, "math")
        return Task(
            self._reference(linearization),
            lambda t: np.array(factors(t), dtype=float),
            np.array(self.initial, dtype=float),
            np.array(self.trim, dtype=float),
            self.duration,
        )

    def _reference(self, linearization: Linearization) -> Callable[[float], tuple[Array, Array]]:
        chain, last = [], []
        for expression, index in zip(self.reference, linearization.index, strict=True):
            chain += [sp.diff(expression, TIME, order) for order in range(index)]
            last.append(sp.diff(expression, TIME, index))
        below, highest = sp.lambdify(TIME, chain, "math"), sp.lambdify(TIME, last, "math")
        return lambda t: (np.array(below(t), dtype=float), np.array(highest(t), dtype=float))
