"""A step of the flying UKF against FilterPy's on the same model, and against the augmented form."""

import math
from collections.abc import Callable
from statistics import median
from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.bench.timing import in_turns, ratio
from ftc_jsb.compiled import compiled, direct
from ftc_jsb.control.protocol import LoopSetup
from ftc_jsb.estimation.augmented import augmented_step
from ftc_jsb.estimation.process import FILTER, Forcing, axes, propagate
from ftc_jsb.estimation.ukf import predict_unscented
from ftc_jsb.estimation.update import update
from ftc_jsb.loops.built_in import loop_settings
from ftc_jsb.point_mass.model import at_condition
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.assembly import point_mass_of
from ftc_jsb.simulation.fly import fly
from ftc_jsb.vocabulary.kernel_types import Vector

Array = npt.NDArray[np.float64]
DT = 0.01  # [s]


@compiled
def _ukf_step(model: Any, settings: Any, filters: Any, u: Vector, y: Vector) -> None:
    s, f = settings[0], filters[0]
    at = at_condition(model[0], y[0], 3048.0)
    forcing = Forcing(u[0], u[1], u[2], False, 0.0, 0.0)
    predict_unscented(f, at, forcing, s.process_noise, s.spread, s.dt)
    update(f, y, s.measurement_noise, s.gate, s.gate_patience, 0.0)


@compiled
def _process(model: Any, filters: Any, u: Vector, x: Vector) -> Any:
    """F of (21), for the filters that are written in Python: they, too, get it compiled."""
    f = filters[0]
    forcing = Forcing(u[0], u[1], u[2], False, 0.0, 0.0)
    for i in range(x.size):
        f.points[0, i] = x[i]
    propagate(at_condition(model[0], x[0], 3048.0), forcing, axes(forcing, x[1]), f, 1, DT)
    return f.points[0, : x.size].copy()


def measure_ukf(rounds: int = 9, samples: int = 60) -> dict[str, float | None]:
    """Median time of a step and ratios; `ukf_vs_filterpy` is None where FilterPy is not installed."""
    from scipy.linalg import block_diag

    scenario = load_scenario("paper", [f"duration={samples * DT}"])
    record = fly(scenario).record
    aircraft = point_mass_of(scenario)
    model = aircraft.record(0.0)
    settings = loop_settings(LoopSetup(aircraft, 0.0, scenario.loop, DT), model)
    inputs = np.stack([record[f"{n}_cmd"] for n in ("thrust", "load_factor", "bank_angle")], axis=1)
    outputs = np.stack(
        [record[f"{n}_meas"] for n in ("airspeed", "flight_path_angle", "heading")], axis=1
    )
    q = np.diag(scenario.loop.estimator.process_noise)
    r = np.diag(scenario.loop.estimator.measurement_noise)
    noise = block_diag(q, r)
    x0 = np.append(outputs[0], 1.0)
    p0 = np.diag(scenario.loop.estimator.initial_covariance)
    filters = np.zeros(1, FILTER)
    filters["count"] = 4
    step = direct(_ukf_step, model, settings, filters, inputs[0], outputs[0])
    process = direct(_process, model, filters, inputs[0], x0)

    def ours() -> int:
        filters["estimate"][0, :4], filters["covariance"][0, :4, :4] = x0, p0
        for u, y in zip(inputs[:-1], outputs[1:], strict=True):
            step(model, settings, filters, u, y)
        return samples

    def observe(x: Array) -> Array:
        return x[:3]

    def augmented() -> int:
        x, p = x0, p0
        for u, y in zip(inputs[:-1], outputs[1:], strict=True):

            def advance(point: Array, u: Array = u) -> Array:
                return np.asarray(process(model, filters, u, np.ascontiguousarray(point)))

            x, p = augmented_step(advance, observe, x, p, noise, y)
        return samples

    works: dict[str, Callable[[], int]] = {"ours": ours, "augmented": augmented}
    theirs = _filterpy(lambda u, x: process(model, filters, u, x), x0, p0, q, r, inputs, outputs)
    if theirs is not None:
        works["filterpy"] = theirs
    times = in_turns(works, rounds)
    return {
        "ukf_us": median(times["ours"]) * 1e6,
        "ukf_vs_filterpy": ratio(times["filterpy"], times["ours"]) if theirs else None,
        "ukf_vs_augmented": ratio(times["augmented"], times["ours"]),
    }


def _filterpy(
    process: Callable[[Array, Array], Array],
    x0: Array,
    p0: Array,
    q: Array,
    r: Array,
    inputs: Array,
    outputs: Array,
) -> Callable[[], int] | None:
    """The same steps by FilterPy's UnscentedKalmanFilter; None where it is not installed."""
    try:
        from filterpy.kalman import JulierSigmaPoints, UnscentedKalmanFilter
    except ImportError:
        return None
    points = JulierSigmaPoints(4, kappa=-1.0)  # the same spread of 3
    ukf = UnscentedKalmanFilter(4, 3, DT, hx=lambda x: x[:3], fx=None, points=points)
    ukf.Q, ukf.R = q, r

    def work() -> int:
        ukf.x, ukf.P = x0.copy(), p0.copy()
        for u, y in zip(inputs[:-1], outputs[1:], strict=True):
            ukf.predict(fx=lambda x, dt, u=u: process(u, x))
            ukf.update(y)
        assert math.isfinite(ukf.x[0])
        return len(inputs) - 1

    return work
