"""Consistency of the filter: NEES and NIS over many seeded flights, against their chi-squared bands."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.compiled import compiled
from ftc_jsb.estimation.cholesky import cholesky, cholesky_solve
from ftc_jsb.estimation.process import FILTER, OUTPUTS, Forcing, axes, propagate
from ftc_jsb.estimation.ukf import predict_unscented
from ftc_jsb.estimation.update import update
from ftc_jsb.point_mass.model import at_condition
from ftc_jsb.vocabulary.kernel_types import Vector

Array = npt.NDArray[np.float64]
BAND = 0.95


class Consistency(NamedTuple):
    """Averages over the flights, a value for each sample, and the band that 95 % should lie in."""

    nees: Array  # (samples,), normalised estimation error squared, mean over flights
    nees_band: tuple[float, float]
    nis: Array  # (samples,), normalised innovation squared
    nis_band: tuple[float, float]

    def inside(self) -> tuple[float, float]:
        """Part of the time that NEES and NIS are inside their bands."""
        return tuple(  # type: ignore[return-value]
            float(np.mean((values >= low) & (values <= high)))
            for values, (low, high) in ((self.nees, self.nees_band), (self.nis, self.nis_band))
        )


class Case(NamedTuple):
    """What the filter's own model flies, open loop, and how uncertain it is."""

    model: npt.NDArray[Any]  # (1,) MODEL
    inputs: Array  # (samples, 3), commands: thrust [N], load factor, bank [rad]
    initial: Array  # (3 + channels,), mean of the initial state; effectiveness of thrust first
    altitude: float  # [m], of the air that is flown in
    dt: float  # sample time [s]
    process_noise: Array  # (3 + channels,), diagonal of Q
    measurement_noise: Array  # (3,), diagonal of R
    initial_covariance: Array  # (3 + channels,), diagonal of P0


class _Noise(NamedTuple):
    """Noise of one flight, and what its filter believes."""

    walk: Array  # (samples, 6), of the state
    measurement: Array  # (samples, 3)
    q: Array  # (6,), as the filter has it
    r: Array  # (3,), likewise


def consistency(case: Case, flights: int, seed: int, believed: float = 1.0) -> Consistency:
    """Fly the filter's own model with its own noise, and see whether its covariance is the truth.

    Plant noise has the filter's Q at every sample, measurements its R, the initial error its P0; the
    effectiveness walks with its Q as well.

    Args:
        case: what is flown.
        flights: how many.
        seed: of the noise.
        believed: what the filter takes R for, as a multiple of the truth; 1 is consistent.
    """
    size = case.initial.size
    random = np.random.default_rng(seed)
    samples = len(case.inputs)
    nees, nis = np.zeros(samples), np.zeros(samples)
    q, r = np.zeros(6), np.asarray(case.measurement_noise, dtype=float)
    q[:size] = case.process_noise
    for _ in range(flights):
        truth = np.zeros(6)
        spread = random.standard_normal(size) * np.sqrt(case.initial_covariance)
        truth[:size] = case.initial + spread
        noise = _Noise(
            random.standard_normal((samples, 6)) * np.sqrt(q),
            random.standard_normal((samples, OUTPUTS)) * np.sqrt(r),
            q,
            believed * r,
        )
        _fly(case, _filter(case), truth, noise, nees, nis)
    return Consistency(nees / flights, _band(size, flights), nis / flights, _band(OUTPUTS, flights))


def _filter(case: Case) -> npt.NDArray[Any]:
    """(1,) FILTER at the start of a flight."""
    size = case.initial.size
    filters = np.zeros(1, FILTER)
    filters["count"] = size
    filters["channel"][0, : size - OUTPUTS] = np.arange(size - OUTPUTS)
    filters["estimate"][0, :size] = case.initial
    filters["covariance"][0, :size, :size] = np.diag(case.initial_covariance)
    return filters


def _band(degrees: int, flights: int) -> tuple[float, float]:
    """Where BAND of the mean over flights of a chi-squared variable lies."""
    from scipy.stats import chi2

    low, high = (1.0 - BAND) / 2.0, (1.0 + BAND) / 2.0
    return (
        float(chi2.ppf(low, flights * degrees) / flights),
        float(chi2.ppf(high, flights * degrees) / flights),
    )


@compiled
def _fly(case: Case, filters: Any, truth: Any, noise: _Noise, nees: Vector, nis: Vector) -> None:
    """One flight; adds its NEES and NIS to the sums."""
    f = filters[0]
    size = f.count
    factor, error, white = np.zeros((6, 6)), np.zeros(6), np.zeros(6)
    y = np.zeros(OUTPUTS)
    for i in range(case.inputs.shape[0]):
        at = at_condition(case.model[0], f.estimate[0], case.altitude)
        forcing = Forcing(case.inputs[i, 0], case.inputs[i, 1], case.inputs[i, 2], False, 0.0, 0.0)
        for a in range(truth.size):
            f.points[0, a] = truth[a]
        propagate(at, forcing, axes(forcing, truth[1]), f, 1, case.dt)
        for a in range(truth.size):
            truth[a] = f.points[0, a]
        for k in range(size):
            truth[k] += noise.walk[i, k]
        for k in range(OUTPUTS):
            y[k] = truth[k] + noise.measurement[i, k]
        predict_unscented(f, at, forcing, noise.q, 3.0, case.dt)
        update(f, y, noise.r, 0.0, 1, 0.0)
        nis[i] += f.nis
        cholesky(f.covariance, size, factor)
        for k in range(size):
            error[k] = truth[k] - f.estimate[k]
            white[k] = error[k]
        cholesky_solve(factor, size, white)
        for k in range(size):
            nees[i] += error[k] * white[k]
