"""The adaptive loop of section 4 on any system: plant, joint estimate, law, trim filter, in one kernel."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled_in_memory
from ftc_jsb.errors import TheoryError
from ftc_jsb.theory.gains import Gains
from ftc_jsb.theory.generated import Kernels, generate
from ftc_jsb.theory.joint_filter import make_filter, make_propagate
from ftc_jsb.theory.law import SOLVED, make_law, trim_step
from ftc_jsb.theory.linearization import Linearization

Array = npt.NDArray[np.float64]


class Settings(NamedTuple):
    """Numbers of the loop; diagonals for the covariances."""

    dt: float  # [s]
    zeta: float  # of (10) [1/s]
    process_noise: Array  # Q: states, then faults
    measurement_noise: Array  # R
    initial_covariance: Array  # P0
    floor: float = 0.05  # sigma
    spread: float = 3.0  # n_a + kappa
    adaptive: bool = True  # False: the true effectiveness in the law, no filter
    substeps: int = 4  # Runge-Kutta steps of the plant a sample


class History(NamedTuple):
    """What was flown, a row for each sample."""

    time: Array  # (rows,)
    state: Array  # (rows, states)
    estimate: Array  # (rows, states + faults)
    deviation: Array  # (rows, states + faults)
    effectiveness: Array  # (rows, inputs), the truth
    command: Array  # (rows, inputs)
    trim: Array  # (rows, inputs), u_n
    error: Array  # (rows, order), e of (16) with the true state
    residual: Array  # (rows, outputs), y^(r) - (y_m^(r) - K e): what the proof calls P x~ and O(.)


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
        self._run = _make_run(self.kernels, self._states, self._inputs, linearization.order)

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
        rows = round(duration / settings.dt) + 1
        order, n, m = self.linearization.order, self._states, self._inputs
        time = np.arange(rows, dtype=np.float64) * settings.dt
        pairs = [reference(t) for t in time]
        wanted_chain = np.array([pair[0] for pair in pairs], dtype=float).reshape(rows, order)
        wanted = np.array([pair[1] for pair in pairs], dtype=float).reshape(rows, m)
        truth = np.array([effectiveness(t) for t in time], dtype=float).reshape(rows, m)
        history = History(
            time,
            np.full((rows, n), np.nan),
            np.full((rows, n + m), np.nan),
            np.full((rows, n + m), np.nan),
            truth,
            np.full((rows, m), np.nan),
            np.full((rows, m), np.nan),
            np.full((rows, order), np.nan),
            np.full((rows, m), np.nan),
        )
        z = np.concatenate([np.asarray(initial, dtype=float), np.ones(m)])
        status, row = self._run(
            np.asarray(initial, dtype=float).copy(), z, np.diag(settings.initial_covariance),
            np.asarray(trim, dtype=float).copy(), wanted_chain, wanted, self.gains.k,
            self.kernels.parameters, settings.process_noise, settings.measurement_noise,
            settings.spread, settings.floor, settings.zeta, settings.dt, settings.substeps,
            settings.adaptive, history,
        )  # fmt: skip
        if status != SOLVED:
            raise TheoryError(self._explain(status, row, history))
        return history

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


NOT_FINITE = 1000


def _make_run(kernels: Kernels, states: int, inputs: int, order: int) -> Callable[..., Any]:
    law, propagate = make_law(kernels), make_propagate(kernels)
    estimate = make_filter(kernels, states, inputs, inputs)
    chain, observe, law_terms = kernels.chain, kernels.outputs, kernels.law_terms
    n, m = states, inputs

    @compiled_in_memory
    def _residual(
        x: Any,
        u: Any,
        truth: Any,
        wanted: Any,
        reference: Any,
        gain: Any,
        p: Any,
        error: Any,
        out: Any,
    ) -> None:
        """E of (16), and y^(r) as it truly is minus what (18) counts on.

        The r-th derivative is that of the exact system: dL_f^(r-1) h/dx F(x, u, k), which the affine
        form gives at u_n = u, where its remainder is zero.
        """
        chain(x, truth, p, error)
        drift, matrix = np.zeros(m), np.zeros((m, m))
        law_terms(x, u, truth, p, drift, matrix)
        for a in range(order):
            error[a] -= reference[a]
        for a in range(m):
            total = drift[a] - wanted[a]
            for b in range(m):
                total += matrix[a, b] * u[b]
            for b in range(order):
                total += gain[a, b] * error[b]
            out[a] = total

    @compiled_in_memory
    def run(
        x: Any,
        z: Any,
        cov: Any,
        u_n: Any,
        wanted_chain: Any,
        wanted: Any,
        gain: Any,
        p: Any,
        q: Any,
        r: Any,
        spread: float,
        floor: float,
        zeta: float,
        dt: float,
        substeps: int,
        adaptive: bool,
        history: Any,
    ) -> tuple[int, int]:
        rows = wanted.shape[0]
        u, y = np.zeros(m), np.zeros(m)
        k = np.ones(m)
        scratch, work = np.zeros((5, n)), np.zeros(2 * order + m * m)
        for i in range(rows):
            truth = history.effectiveness[i]
            observe(x, p, y)
            if adaptive and i > 0:
                estimate(z, cov, u, y, p, q, r, spread, floor, dt)
            if not adaptive:
                z[:n] = x
                z[n:] = truth
            for j in range(m):
                k[j] = max(z[n + j], floor)
            history.state[i] = x
            history.estimate[i] = z
            history.trim[i] = u_n
            for j in range(n + m):
                history.deviation[i, j] = math.sqrt(max(cov[j, j], 0.0))
            status = law(z[:n], u_n, k, p, wanted[i], gain, wanted_chain[i], work, u)
            if status != SOLVED:
                return status, i
            history.command[i] = u
            _residual(
                x,
                u,
                truth,
                wanted[i],
                wanted_chain[i],
                gain,
                p,
                history.error[i],
                history.residual[i],
            )
            for _ in range(substeps):
                propagate(x, u, truth, p, dt / substeps, scratch)
            for j in range(n):
                if not math.isfinite(x[j]):
                    return NOT_FINITE, i
            trim_step(u_n, u, zeta, dt)
        return SOLVED, rows - 1

    return run
