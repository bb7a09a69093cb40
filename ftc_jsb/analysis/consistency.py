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


def consistency(
    model: npt.NDArray[Any],
    inputs: Array,
    initial: Array,
    altitude: float,
    channels: int,
    process_noise: Array,
    measurement_noise: Array,
    initial_covariance: Array,
    dt: float,
    flights: int,
    seed: int,
    believed: float = 1.0,
) -> Consistency:
    """Fly the filter's own model with its own noise, and see whether its covariance is the truth.

    Plant noise has the filter's Q at every sample, measurements its R, the initial error its P0; the
    effectiveness walks with its Q as well.

    Args:
        model: (1,) MODEL.
        inputs: (samples, 3), commands that are flown, open loop: thrust [N], load factor, bank [rad].
        initial: (3 + channels,), mean of the initial state.
        altitude: [m], of the air that is flown in.
        channels: how many effectiveness factors are estimated, thrust first.
        process_noise, measurement_noise, initial_covariance: diagonals.
        dt: sample time [s].
        flights: how many.
        seed: of the noise.
        believed: what the filter takes R for, as a multiple of the truth; 1 is consistent.
    """
    from scipy.stats import chi2

    size = OUTPUTS + channels
    random = np.random.default_rng(seed)
    nees, nis = np.zeros(len(inputs)), np.zeros(len(inputs))
    q, r = np.zeros(6), np.asarray(measurement_noise, dtype=float)
    q[:size] = process_noise
    for _ in range(flights):
        filters = np.zeros(1, FILTER)
        filters["count"] = size
        filters["channel"][0, :channels] = np.arange(channels)
        truth = np.zeros(6)
        truth[:size] = initial + random.standard_normal(size) * np.sqrt(initial_covariance)
        filters["estimate"][0, :size] = initial
        filters["covariance"][0, :size, :size] = np.diag(initial_covariance)
        walk = random.standard_normal((len(inputs), 6)) * np.sqrt(q)
        noise = random.standard_normal((len(inputs), OUTPUTS)) * np.sqrt(r)
        _fly(model, filters, truth, inputs, altitude, walk, noise, q, believed * r, dt, nees, nis)
    low, high = (1.0 - BAND) / 2.0, (1.0 + BAND) / 2.0
    bands = [
        (
            float(chi2.ppf(low, flights * degrees) / flights),
            float(chi2.ppf(high, flights * degrees) / flights),
        )
        for degrees in (size, OUTPUTS)
    ]
    return Consistency(nees / flights, bands[0], nis / flights, bands[1])


@compiled
def _fly(
    model: Any,
    filters: Any,
    truth: Any,
    inputs: Any,
    altitude: float,
    walk: Any,
    noise: Any,
    q: Any,
    r: Any,
    dt: float,
    nees: Any,
    nis: Any,
) -> None:
    """One flight; adds its NEES and NIS to the sums."""
    f = filters[0]
    size = f.count
    factor, error, white = np.zeros((6, 6)), np.zeros(6), np.zeros(6)
    y = np.zeros(OUTPUTS)
    for i in range(inputs.shape[0]):
        at = at_condition(model[0], f.estimate[0], altitude)
        forcing = Forcing(inputs[i, 0], inputs[i, 1], inputs[i, 2], False, 0.0, 0.0)
        for a in range(truth.size):
            f.points[0, a] = truth[a]
        propagate(at, forcing, axes(forcing, truth[1]), f, 1, dt)
        for a in range(truth.size):
            truth[a] = f.points[0, a]
        for k in range(size):
            truth[k] += walk[i, k]
        for k in range(OUTPUTS):
            y[k] = truth[k] + noise[i, k]
        predict_unscented(f, at, forcing, q, 3.0, dt)
        update(f, y, r, 0.0, 1, 0.0)
        nis[i] += f.nis
        cholesky(f.covariance, size, factor)
        for k in range(size):
            error[k] = truth[k] - f.estimate[k]
            white[k] = error[k]
        cholesky_solve(factor, size, white)
        for k in range(size):
            nees[i] += error[k] * white[k]
