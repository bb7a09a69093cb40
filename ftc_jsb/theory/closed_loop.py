"""The adaptive loop of section 4 on any system: generated, compiled, flown along a reference."""

import warnings
from collections.abc import Callable
from typing import Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.errors import TheoryError
from ftc_jsb.theory.gains import Gains
from ftc_jsb.theory.generated import Kernels, generate
from ftc_jsb.theory.kernels.closed_loop import (
    ESTIMATE,
    FILTER_FAILED,
    HEALTHY,
    NOT_FINITE,
    TRUTH,
    Actuators,
    Constants,
    History,
    LoopState,
    World,
)
from ftc_jsb.theory.kernels.joint_filter import NOT_DEFINITE, FilterSettings
from ftc_jsb.theory.kernels.law import SOLVED, Tuning
from ftc_jsb.theory.linearization import Linearization
from ftc_jsb.theory.system import System
from ftc_jsb.theory.zero_dynamics import input_scale, zero_dynamics

__all__ = ["ClosedLoop", "Conditions", "History", "Settings"]

Array = npt.NDArray[np.float64]
Signal = Callable[[float], Array]
Loop = Literal["ftc", "ekf", "oracle", "no-ftc"]
LEAST_SPREAD = 3.0  # n_a + kappa as the paper has it
TOLD = {"ftc": ESTIMATE, "ekf": ESTIMATE, "oracle": TRUTH, "no-ftc": HEALTHY}


class TheoryWarning(UserWarning):
    """What may be flown and will hardly end well."""


class Settings(NamedTuple):
    """Numbers of the loop; diagonals for the covariances."""

    dt: float  # [s]
    zeta: float  # of (10) [1/s]
    process_noise: Array  # Q a sample: states, then faults
    measurement_noise: Array  # R
    initial_covariance: Array  # P0
    floor: float = 0.05  # sigma
    spread: float | None = None  # n_a + kappa; None: 3, or states + faults where that is more
    loop: Loop = "ftc"  # by UKF or EKF; with the truth; with the states and k = 1
    substeps: int = 4  # Runge-Kutta steps of the plant a sample


class Conditions(NamedTuple):
    """What a flight meets beside the loss of effectiveness; nothing by default."""

    offset: Signal | None = None  # added to each efficacious input
    held: Signal | None = None  # where inputs are stuck; nan = free
    sensor: Signal | None = None  # error of each measurement; nan = lost
    plant_noise: Array | None = None  # (plant states,), standard deviation added a sample
    sensor_noise: Array | None = None  # (measured,), standard deviation
    low: Array | None = None  # (inputs,), limits of the command
    high: Array | None = None
    rate: Array | None = None  # (inputs,), of the command [1/s]
    lag: Array | None = None  # (inputs,), of the actuators [s]
    seed: int = 0  # of both noises
    plant_initial: Array | None = None  # (plant states,); the filter starts at `initial`
    told: Signal | None = None  # effectiveness that the loop `oracle` goes by, if not the truth


NOTHING_ELSE = Conditions()


class FlightEndedError(TheoryError):
    """A flight that could not go on, with what was flown."""

    def __init__(self, text: str, history: History) -> None:
        """Args: why and when; the rows before that."""
        super().__init__(text)
        self.history = history


class ClosedLoop:
    """A system with its law, filter and plant, compiled."""

    def __init__(
        self,
        linearization: Linearization,
        gains: Gains,
        plant: System | None = None,
        kernels: Kernels | None = None,
    ) -> None:
        """Generate; compiled with the first flight, or taken from the disk.

        Args:
            linearization: of the system that law and filter go by.
            gains: for its A and B.
            plant: what is flown, if not that system.
            kernels: of both, if they are at hand.

        Raises:
            TheoryError: the plant does not fit.
        """
        self.linearization = linearization
        self.gains = gains
        self.plant = plant or linearization.system
        self.kernels = kernels or generate(linearization, plant)

    def fly(
        self,
        reference: Callable[[float], tuple[Array, Array]],
        effectiveness: Signal,
        initial: Array,
        trim: Array,
        duration: float,
        settings: Settings,
        conditions: Conditions = NOTHING_ELSE,
    ) -> History:
        """Track a reference.

        Args:
            reference: time to (Y_m (order,), y_m^(r) (outputs,)).
            effectiveness: time to k (inputs,).
            initial: state (states,).
            trim: u_n(0) (inputs,).
            duration: [s].
            settings: of the loop.
            conditions: noise, limits and other faults.

        Raises:
            FlightEndedError: G of (14) is singular on the way, a covariance is no longer positive
                definite, or the state leaves the finite numbers; says where, and has what was flown.
        """
        warn_of_zero_dynamics(self.linearization, initial, trim)
        history, world = self._prepare(reference, effectiveness, duration, settings, conditions)
        status, row = self.kernels.run(
            self._start(initial, trim, settings, conditions),
            world,
            self._constants(trim, settings, conditions),
            history,
        )
        if status != SOLVED:
            why = self._explain(status, row, history, settings) + self._since(row, history)
            raise FlightEndedError(why, _up_to(row, history))
        return history

    def _prepare(
        self,
        reference: Callable[[float], tuple[Array, Array]],
        effectiveness: Signal,
        duration: float,
        settings: Settings,
        conditions: Conditions,
    ) -> tuple[History, World]:
        """A history that holds the reference and nothing else, and what acts along it."""
        time = np.arange(round(duration / settings.dt) + 1, dtype=np.float64) * settings.dt
        system, linear = self.linearization.system, self.linearization
        n, m, rows = len(system.states), len(system.inputs), time.size
        z, measured = n + len(system.fallible), len(system.measured)
        pairs = [reference(t) for t in time]
        blank = {
            "state": len(self.plant.states), "measured": measured, "estimate": z, "deviation": z,
            "known": n + m, "wanted": m, "command": m, "delivered": m, "trim": m,
            "error": linear.order,
        }  # fmt: skip
        truth = _along(effectiveness, time, m, 1.0)
        history = History(
            time=time,
            effectiveness=truth,
            reference=np.array([pair[0] for pair in pairs], float).reshape(rows, linear.order),
            derivative=np.array([pair[1] for pair in pairs], float).reshape(rows, -1),
            **{name: np.full((rows, size), np.nan) for name, size in blank.items()},
        )
        random = np.random.default_rng(conditions.seed)
        push = random.standard_normal((rows, len(self.plant.states)))
        noise = random.standard_normal((rows, measured))
        world = World(
            truth,
            truth if conditions.told is None else _along(conditions.told, time, m, 1.0),
            _along(conditions.offset, time, m, 0.0),
            _along(conditions.held, time, m, np.nan),
            push * _or(conditions.plant_noise, push.shape[1], 0.0),
            noise * _or(conditions.sensor_noise, measured, 0.0)
            + _along(conditions.sensor, time, measured, 0.0),
        )
        return history, world

    def _start(
        self, initial: Array, trim: Array, settings: Settings, conditions: Conditions
    ) -> LoopState:
        state = initial if conditions.plant_initial is None else conditions.plant_initial
        fallible = np.ones(len(self.linearization.system.fallible))
        return LoopState(
            np.array(state, dtype=float),
            np.concatenate([np.asarray(initial, dtype=float), fallible]),
            np.diag(np.asarray(settings.initial_covariance, dtype=float)),
            np.array(trim, dtype=float),
            np.array(trim, dtype=float),
            np.array(trim, dtype=float),
        )

    def _constants(self, trim: Array, settings: Settings, conditions: Conditions) -> Constants:
        m = len(trim)
        actuators = Actuators(
            _or(conditions.low, m, -np.inf),
            _or(conditions.high, m, np.inf),
            _or(conditions.rate, m, np.inf),
            _or(conditions.lag, m, 0.0),
        )
        scale = np.maximum(input_scale(self.linearization), np.abs(trim))
        tuning = Tuning(self.gains.k, scale, np.array(trim, dtype=float))
        return Constants(
            tuning,
            filter_settings(settings),
            actuators,
            self.kernels.parameters,
            self.kernels.plant_parameters,
            settings.zeta,
            TOLD[settings.loop],
            settings.substeps,
        )

    def _since(self, row: int, history: History) -> str:
        """Since when the state has been outside the system's ranges, if it has: what failed may follow."""
        low, high = np.array([self.plant.range_of(symbol) for symbol in self.plant.states]).T
        state = history.state[: row + 1]
        inside = np.flatnonzero(((state >= low) & (state <= high)).all(axis=1))
        if row in inside:
            return ""
        since = history.time[inside[-1] + 1] if len(inside) else 0.0
        return f"; the state has been outside the ranges of the system since {since:.3f} s"

    def _explain(self, status: int, row: int, history: History, settings: Settings) -> str:
        system = self.linearization.system
        at = f"{history.time[row]:.3f} s"
        where = dict(zip(map(str, self.plant.states), history.state[row].tolist(), strict=True))
        if status >= FILTER_FAILED:
            kind = "state" if status - FILTER_FAILED == NOT_DEFINITE else "innovation"
            size = len(system.states) + len(system.fallible)
            hint = f"; a spread of at least {size}, states + faults, keeps every weight of (29) positive"
            return (
                f"system {system.name!r}: the covariance of the {kind} is not positive definite at {at}"
                f"{hint if filter_settings(settings).spread < size else ''}"
            )
        if status == NOT_FINITE:
            return f"system {system.name!r}: not finite at {at}, state {where}"
        return (
            f"system {system.name!r}: G of (14) is singular at {at}: input {system.inputs[status]} "
            f"moves no output of its own there, or too little of it; state {where}, u_n "
            f"{history.trim[row].tolist()}"
        )


def _up_to(row: int, history: History) -> History:
    """The rows of a flight that were flown whole, the last at `row` or before; at least one."""
    whole = np.isfinite(history.error[: row + 1]).all(axis=1)
    rows = row + 1 if whole.all() else max(int(np.argmin(whole)), 1)
    return History(*(column[:rows] for column in history))


def filter_settings(settings: Settings) -> FilterSettings:
    """Numbers of the filter as its kernel takes them."""
    noise = np.array(settings.process_noise, dtype=float)
    return FilterSettings(
        noise,
        np.array(settings.measurement_noise, dtype=float),
        settings.spread or max(LEAST_SPREAD, float(len(noise))),
        settings.floor,
        settings.dt,
        settings.loop == "ekf",
    )


def warn_of_zero_dynamics(linearization: Linearization, initial: Array, trim: Array) -> None:
    """Warn where the states that the outputs do not show run away from the start of a flight."""
    found = zero_dynamics(linearization, list(initial), list(trim))
    if found.verdict == "unstable":
        worst = found.zeros[np.argmax(found.zeros.real)]
        warnings.warn(
            f"system {linearization.system.name!r}: zero dynamics of dimension {found.dimension} are "
            f"unstable at the start: a zero at {worst:.3g} 1/s; outputs can be held while the states "
            "run away",
            TheoryWarning,
            stacklevel=3,
        )


def _along(signal: Signal | None, time: Array, size: int, default: float) -> Array:
    """(rows, size): a signal at each sample."""
    if signal is None:
        return np.full((time.size, size), default)
    return np.array([signal(t) for t in time], dtype=float).reshape(time.size, size)


def _or(values: Array | None, size: int, default: float) -> Array:
    """(size,): what is given, or the default for each."""
    return np.full(size, default) if values is None else np.array(values, dtype=float)
