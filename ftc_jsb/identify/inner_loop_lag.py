"""Fit of the closed inner loop: load factor and bank angle as second-order lags of their commands."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled
from ftc_jsb.identify.regression import Array
from ftc_jsb.point_mass.response import lag_step
from ftc_jsb.vocabulary.kernel_types import Vector


class Lag(NamedTuple):
    """A second-order lag, and how well it fits."""

    frequency: float  # [rad/s]
    damping: float
    rate_max: float  # [unit/s]
    acceleration_max: float  # [unit/s^2]
    residual: float  # RMS, in the variable's unit


UNLIMITED = 0.0


@compiled
def second_order(
    command: Vector,
    frequency: float,
    damping: float,
    rate_max: float,
    acceleration_max: float,
    dt: float,
) -> Any:
    """Response of the lag to held commands, from rest on the first; (samples,) in and out.

    Limits of rate and acceleration as in `point_mass.response.lag_step`.
    """
    out = np.empty(command.size)
    value, rate = command[0], 0.0
    for i in range(command.size):
        out[i] = value
        value, rate = lag_step(
            value, rate, command[i], frequency, damping, rate_max, acceleration_max, dt
        )
    return out


def fit_lag(records: list[npt.NDArray[Any]], name: str, dt: float, limited: bool = False) -> Lag:
    """Lag of `name` (`load_factor`, `bank_angle`) behind its command over whole flights.

    Args:
        records: test flights.
        name: of the variable; its command is `<name>_cmd`.
        dt: sample time [s].
        limited: fit a limit of rate and acceleration too.
    """
    from scipy.optimize import least_squares

    pairs = []
    for record in records:
        command, actual = record[f"{name}_cmd"].copy(), record[name].copy()
        command[0] = actual[0]
        pairs.append((command, actual))

    def parameters(free: Array) -> tuple[float, float, float, float]:
        rate, acceleration = (free[2], free[3]) if limited else (UNLIMITED, UNLIMITED)
        return float(free[0]), float(free[1]), float(rate), float(acceleration)

    def residual(free: Array) -> Array:
        return np.concatenate(
            [second_order(command, *parameters(free), dt) - actual for command, actual in pairs]
        )

    free = 4 if limited else 2
    result = least_squares(
        residual,
        [5.0, 0.8, 2.0, 10.0][:free],
        bounds=([1.0, 0.2, 0.1, 0.5][:free], [30.0, 2.0, 20.0, 200.0][:free]),
        x_scale=[1.0, 0.1, 0.5, 5.0][:free],
        diff_step=np.full(free, 1e-3),
    )
    rms = float(np.sqrt(np.mean(result.fun**2)))
    return Lag(*parameters(result.x), rms)
