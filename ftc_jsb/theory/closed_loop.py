"""The adaptive loop of section 4 on any system: generated, compiled, flown along a reference."""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from ftc_jsb.errors import TheoryError
from ftc_jsb.theory.closed_loop_kernel import (
    NOT_FINITE,
    Constants,
    History,
    LoopState,
    Settings,
    make_run,
)
from ftc_jsb.theory.gains import Gains
from ftc_jsb.theory.generated import generate
from ftc_jsb.theory.law import SOLVED, Reference
from ftc_jsb.theory.linearization import Linearization

__all__ = ["ClosedLoop", "History", "Settings"]

Array = npt.NDArray[np.float64]


class ClosedLoop:
    """A system with its law, filter and plant, compiled."""

    def __init__(self, linearization: Linearization, gains: Gains) -> None:
        """Generate and compile.

        Args:
            linearization: of the system.
            gains: for its A and B.
        """
        self.linearization = linearization
        self.gains = gains
        self.kernels = generate(linearization)
        system = linearization.system
        self._states, self._inputs = len(system.states), len(system.inputs)
        self._run = make_run(self.kernels, self._states, self._inputs, linearization.order)

    def fly(
        self,
        reference: Callable[[float], tuple[Array, Array]],
        effectiveness: Callable[[float], Array],
        initial: Array,
        trim: Array,
        duration: float,
        settings: Settings,
    ) -> History:
        """Track a reference.

        Args:
            reference: time to (Y_m (order,), y_m^(r) (outputs,)).
            effectiveness: time to k (inputs,).
            initial: state (states,).
            trim: u_n(0) (inputs,).
            duration: [s].
            settings: of the loop.

        Raises:
            TheoryError: G of (14) is singular on the way, or the state leaves the finite numbers; says
                where.
        """
        time = np.arange(round(duration / settings.dt) + 1, dtype=np.float64) * settings.dt
        history = self._blank_history(time, effectiveness)
        start = LoopState(
            np.array(initial, dtype=float),
            np.concatenate([np.asarray(initial, dtype=float), np.ones(self._inputs)]),
            np.diag(settings.initial_covariance),
            np.array(trim, dtype=float),
            np.zeros(self._inputs),
        )
        status, row = self._run(
            start, self._along(time, reference), self._constants(settings), history
        )
        if status != SOLVED:
            raise TheoryError(self._explain(status, row, history))
        return history

    def _blank_history(self, time: Array, effectiveness: Callable[[float], Array]) -> History:
        rows, n, m = time.size, self._states, self._inputs
        truth = np.array([effectiveness(t) for t in time], dtype=float).reshape(rows, m)
        return History(
            time=time,
            state=np.full((rows, n), np.nan),
            estimate=np.full((rows, n + m), np.nan),
            deviation=np.full((rows, n + m), np.nan),
            effectiveness=truth,
            command=np.full((rows, m), np.nan),
            trim=np.full((rows, m), np.nan),
            error=np.full((rows, self.linearization.order), np.nan),
            residual=np.full((rows, m), np.nan),
        )

    def _along(self, time: Array, reference: Callable[[float], tuple[Array, Array]]) -> Reference:
        pairs = [reference(t) for t in time]
        chain = np.array([pair[0] for pair in pairs], dtype=float)
        derivative = np.array([pair[1] for pair in pairs], dtype=float)
        return Reference(
            chain.reshape(time.size, self.linearization.order),
            derivative.reshape(time.size, self._inputs),
        )

    def _constants(self, settings: Settings) -> Constants:
        as_arrays = settings._replace(
            process_noise=np.asarray(settings.process_noise, dtype=float),
            measurement_noise=np.asarray(settings.measurement_noise, dtype=float),
            initial_covariance=np.asarray(settings.initial_covariance, dtype=float),
        )
        return Constants(self.gains.k, self.kernels.parameters, as_arrays)

    def _explain(self, status: int, row: int, history: History) -> str:
        system = self.linearization.system
        where = dict(zip(map(str, system.states), history.state[row].tolist(), strict=True))
        if status == NOT_FINITE:
            return f"system {system.name!r}: not finite at {history.time[row]:.3f} s, state {where}"
        return (
            f"system {system.name!r}: G of (14) is singular at {history.time[row]:.3f} s: input "
            f"{system.inputs[status]} moves no output of its own there; state {where}, u_n "
            f"{history.trim[row].tolist()}"
        )
