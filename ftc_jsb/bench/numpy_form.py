"""The paper's loop on the paper's point mass in plain NumPy: what the compiled form is compared with.

Plant, UKF, law, limits and filters as a reader with the paper in hand would write them, arrays for the
sigma points, no kernels; a test sees that it flies the same flight.
"""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.control.command_filter import command_filter
from ftc_jsb.scenario.reference import raw_commands
from ftc_jsb.scenario.schema import Scenario

Array = npt.NDArray[np.float64]


class _Tuning(NamedTuple):
    """Numbers of the filter."""

    q: Array  # (states, states), covariance of the process noise a step
    r: Array  # (outputs, outputs), of the measurement noise
    spread: float  # n_a + kappa
    dt: float  # [s]


def fly_in_numpy(scenario: Scenario, model: Any, trim_thrust: float, samples: int) -> Array:
    """States of the scenario's flight with the loop `ftc`, priority "none", one fault of the thrust.

    Args:
        scenario: flown; its first fault is a step of the thrust's effectiveness.
        model: MODEL record with constant density, one Mach knot and no angle of attack.
        trim_thrust: at the start [N].
        samples: to fly.

    Returns:
        (samples, 5): airspeed, flight path angle, heading, altitude, estimated effectiveness.
    """
    loop, dt = scenario.loop, 1.0 / scenario.loop.rate
    raw = raw_commands(scenario.reference, np.arange(samples + 1, dtype=np.float64) * dt)[:, :3]
    held = command_filter(
        scenario.reference.filter_frequency, scenario.reference.filter_damping, dt, raw[0]
    )[0]
    transition, from_now, from_next = held["transition"], held["from_now"], held["from_next"]
    follow = np.stack([raw[0], np.zeros(3)])  # value and slope of the references
    tuning = _Tuning(
        np.diag(loop.estimator.process_noise),
        np.diag(loop.estimator.measurement_noise),
        loop.estimator.spread,
        dt,
    )
    gains = np.array(loop.gains)
    x = np.array([*raw[0], 0.0, 0.0, scenario.initial.altitude])
    estimate, covariance = np.append(x[:3], 1.0), np.diag(loop.estimator.initial_covariance)
    trim = np.array([trim_thrust, np.cos(x[1]), 0.0])
    u = trim.copy()
    fault = scenario.fault[0]
    share = 1.0 - np.exp(-loop.trim_filter * dt)
    thrust_limits = (model["thrust_idle"][0, 0], model["thrust_maximum"][0, 0])
    result = np.empty((samples, 5))
    for i in range(samples):
        measurement = x[:3].copy()
        if i > 0:
            estimate, covariance = _filter(model, estimate, covariance, u, measurement, tuning)
        result[i, :3], result[i, 3], result[i, 4] = x[:3], x[5], estimate[3]
        wanted = follow[1] - gains * (measurement - follow[0])
        u = trim + _law(model, estimate, trim, wanted, loop.effectiveness_floor)
        pressure_area = 0.5 * model["constant_density"] * measurement[0] ** 2 * model["area"]
        most = model["lift_coefficient_max"] * pressure_area / (model["mass"] * model["gravity"])
        u[0] = np.clip(u[0], *thrust_limits)
        u[1] = np.clip(u[1], model["load_factor_min"], min(model["load_factor_max"], most))
        u[2] = np.clip(u[2], -np.pi, np.pi)
        trim = trim + share * (u - trim)
        faulty = fault.effectiveness is not None and i * dt >= fault.start - 1e-9
        left = fault.effectiveness if faulty else 1.0
        x = _runge_kutta(model, x, np.array([left * u[0], u[1], u[2]]), dt)
        follow = transition @ follow + np.outer(from_now, raw[i]) + np.outer(from_next, raw[i + 1])
    return result


def _rates(model: Any, x: Array, u: Array) -> Array:
    """(41)-(43); `x` (states, ...), `u` (3, ...)."""
    g, weight = model["gravity"], model["mass"] * model["gravity"]
    pressure_area = 0.5 * model["constant_density"] * x[0] ** 2 * model["area"]
    lift = u[1] * weight / pressure_area
    c = model["drag"][0]
    drag = pressure_area * (c[0] + lift * (c[1] + lift * c[2]))
    rates = np.zeros_like(x)
    rates[0] = g * ((u[0] - drag) / weight - np.sin(x[1]))
    rates[1] = g / x[0] * (u[1] * np.cos(u[2]) - np.cos(x[1]))
    rates[2] = g * u[1] * np.sin(u[2]) / (x[0] * np.cos(x[1]))
    if len(x) == 6:  # (42)
        level = x[0] * np.cos(x[1])
        rates[3:] = level * np.cos(x[2]), level * np.sin(x[2]), x[0] * np.sin(x[1])
    return rates


def _runge_kutta(model: Any, x: Array, u: Array, dt: float) -> Array:
    k1 = _rates(model, x, u)
    k2 = _rates(model, x + 0.5 * dt * k1, u)
    k3 = _rates(model, x + 0.5 * dt * k2, u)
    k4 = _rates(model, x + dt * k3, u)
    return np.asarray(x + dt / 6.0 * (k1 + 2.0 * (k2 + k3) + k4))


def _filter(
    model: Any, x: Array, p: Array, u: Array, y: Array, tuning: _Tuning
) -> tuple[Array, Array]:
    """(26)-(34) in the reduced form."""
    n, r = len(x), tuning.r
    root = np.linalg.cholesky(tuning.spread * p)
    points = np.column_stack([x, x[:, None] + root, x[:, None] - root])  # (26)
    weights = np.full(2 * n + 1, 0.5 / tuning.spread)  # (29)
    weights[0] = 1.0 - n / tuning.spread
    inputs = np.stack([u[0] * points[3], *(np.full(2 * n + 1, value) for value in u[1:])])
    points[:3] = _runge_kutta(model, points[:3], inputs, tuning.dt)  # (27)
    mean = points[:, 0] + (points - points[:, :1]) @ weights  # (28)
    away = points - mean[:, None]
    p = (away * weights) @ away.T + tuning.q  # (30)
    gain = np.linalg.solve(p[:3, :3] + r, p[:3]).T  # (31)-(33): the outputs are the first states
    keep = np.eye(n) - np.pad(gain, ((0, 0), (0, n - 3)))
    return mean + gain @ (y - mean[:3]), keep @ p @ keep.T + gain @ r @ gain.T  # (34)


def _law(model: Any, estimate: Array, trim: Array, wanted: Array, floor: float) -> Array:
    """G^-1 (wanted - F) of (17), (20)."""
    v, path, left = estimate[0], estimate[1], max(estimate[3], floor)
    thrust, n, bank = left * trim[0], trim[1], trim[2]
    at_trim = _rates(model, estimate[:3], np.array([thrust, n, bank]))
    g, mass = model["gravity"], model["mass"]
    pressure_area = 0.5 * model["constant_density"] * v**2 * model["area"]
    c = model["drag"][0]
    slope = c[1] + 2.0 * c[2] * n * mass * g / pressure_area
    matrix = np.array(
        [
            [left / mass, -slope * g, 0.0],
            [0.0, g / v * np.cos(bank), -g / v * n * np.sin(bank)],
            [0.0, *(g / (v * np.cos(path)) * np.array([np.sin(bank), n * np.cos(bank)]))],
        ]
    )
    return np.linalg.solve(matrix, wanted - at_trim)
