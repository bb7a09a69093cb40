"""The flying filter against FilterPy and against (22)-(34) as printed, and what it does with bad data."""

from typing import Any

import numpy as np
import pytest
from filterpy.kalman import JulierSigmaPoints, UnscentedKalmanFilter
from scipy.linalg import block_diag

from ftc_jsb.compiled import compiled
from ftc_jsb.control.protocol import LoopSetup
from ftc_jsb.estimation.process import FILTER, Forcing, axes, propagate
from ftc_jsb.estimation.ukf import predict_unscented
from ftc_jsb.estimation.update import update
from ftc_jsb.loops.built_in import loop_settings
from ftc_jsb.point_mass.model import at_condition
from ftc_jsb.scenario.load import load_scenario
from tests.point_mass.models import AIRCRAFT, PAPER

LOOP = load_scenario("paper").loop
Q = np.diag(LOOP.estimator.process_noise)
R = np.diag(LOOP.estimator.measurement_noise)
P0 = np.diag(LOOP.estimator.initial_covariance)


@compiled
def _sample(model: Any, filters: Any, v: float, h: float, u: Any, point: Any, dt: float) -> None:
    forcing = Forcing(u[0], u[1], u[2], False, 0.0, 0.0)
    near = axes(forcing, point[1])
    points = filters[0].points
    for a in range(point.size):
        points[0, a] = point[a]
    propagate(at_condition(model[0], v, h), forcing, near, filters[0], 1, dt)
    for a in range(point.size):
        point[a] = points[0, a]


def process(x: np.ndarray, u: np.ndarray, row: Any, dt: float = 0.01) -> np.ndarray:
    """F of (21) for one state [V, path, heading, k], at the measured flight condition of `row`."""
    filters = np.zeros(1, FILTER)
    filters["count"] = 4
    point = np.zeros(6)
    point[:4] = x
    _sample(PAPER, filters, row["airspeed_meas"], row["altitude_meas"], u, point, dt)
    return point[:4]


def inputs_and_measurements(record: Any) -> tuple[np.ndarray, np.ndarray]:
    u = np.stack(
        [record["thrust_cmd"], record["load_factor_demand"], record["bank_angle_demand"]], 1
    )
    names = ("airspeed_meas", "flight_path_angle_meas", "heading_meas")
    return u, np.stack([record[name] for name in names], axis=1)


ESTIMATES = (
    "airspeed_est",
    "flight_path_angle_est",
    "heading_est",
    "effectiveness_thrust_est",
)


def test_whole_flight_agrees_with_filterpy(flown):
    """FilterPy's UKF on the same model, inputs and measurements: 1e-9 relative over the 60 s.

    kappa = 3 - 4 there, the same spread of 3. FilterPy reuses the propagated points for the
    measurement; they are redrawn from the predicted covariance, Q included, as the augmented
    form has it. How near they come depends on the last bits of the measurements, since FilterPy
    inverts a P_yy of condition 1e7: the flight is the one of 4 Runge-Kutta steps a sample.
    """
    record = flown("paper", "simulation.point_mass_steps=4").record
    u, y = inputs_and_measurements(record)
    points = JulierSigmaPoints(4, kappa=-1.0)
    ukf = UnscentedKalmanFilter(4, 3, 0.01, hx=lambda x: x[:3], fx=None, points=points)
    ukf.x, ukf.P, ukf.Q, ukf.R = np.append(y[0], 1.0), P0.copy(), Q, R
    for i in range(1, record.size):
        ukf.predict(fx=lambda x, dt, i=i: process(x, u[i - 1], record[i], dt))
        ukf.sigmas_f = points.sigma_points(ukf.x, ukf.P)
        ukf.update(y[i])
        ours = [record[i][name] for name in ESTIMATES]
        np.testing.assert_allclose(ours, ukf.x, rtol=1e-9, atol=1e-11, err_msg=f"row {i}")
    assert record["effectiveness_thrust_std"][-1] == pytest.approx(np.sqrt(ukf.P[3, 3]), rel=1e-6)


def test_reduced_form_is_the_augmented_one_as_printed(flown):
    """(22)-(34) literally, 11 augmented states and 23 points, each step of the 3 s around the fault.

    The outputs are linear in the state, where the two forms are the same but for rounding, which the
    inverse of P_yy amplifies: 1e-10 for
    the estimate; 1e-6 for the covariance, whose printed form (34) cancels seven digits.
    """
    record = flown("paper").record
    u, y = inputs_and_measurements(record)
    start = 1900
    ours = Filter(np.array([record[start][name] for name in ESTIMATES]), P0)
    for i in range(start + 1, start + 300):
        x, p = augmented_step(ours.x, ours.p, u[i - 1], y[i], record[i])
        ours.step(u[i - 1], y[i], record[i])
        np.testing.assert_allclose(ours.x, x, rtol=1e-10, atol=1e-12)
        deviation = np.sqrt(np.diag(ours.p))
        np.testing.assert_allclose(
            ours.p / np.outer(deviation, deviation), p / np.outer(deviation, deviation), atol=1e-6
        )
    assert abs(ours.x[3] - 0.6) < 0.01


def augmented_step(x, p, u, y, row):
    """One step of (22)-(34) with the paper's own augmented vector [x, v, xi]."""
    na, kappa = 11, 3 - 11
    xa = np.concatenate([x, np.zeros(7)])  # (22), (23)
    pa = block_diag(p, Q, R)  # (25)
    root = np.linalg.cholesky((na + kappa) * pa)
    points = np.column_stack([xa, xa[:, None] + root, xa[:, None] - root])  # (26)
    weights = np.full(2 * na + 1, 0.5 / (na + kappa))  # (29)
    weights[0] = kappa / (na + kappa)
    chi = np.stack([process(a[:4], u, row) + a[4:8] for a in points.T], axis=1)  # (27)
    mean = chi[:, 0] + (chi - chi[:, :1]) @ weights  # (28)
    spread = chi - mean[:, None]
    predicted = (spread * weights) @ spread.T  # (30)
    outputs = chi[:3] + points[8:11]  # (31) with the noise part that it lacks in print
    output = outputs[:, 0] + (outputs - outputs[:, :1]) @ weights  # (32)
    away = outputs - output[:, None]
    pyy = (away * weights) @ away.T  # (33)
    pxy = (spread * weights) @ away.T
    gain = pxy @ np.linalg.inv(pyy)
    return mean + gain @ (y - output), predicted - gain @ pyy @ gain.T  # (34)


class Filter:
    """The flying filter, one step at a time."""

    def __init__(self, x: np.ndarray, p: np.ndarray, **estimator: Any) -> None:
        loop = LOOP.model_copy(update={"estimator": LOOP.estimator.model_copy(update=estimator)})
        self.settings = loop_settings(LoopSetup(AIRCRAFT, 0.0, loop, 0.01), PAPER)
        self.filters = np.zeros(1, FILTER)
        self.filters["count"] = 4
        self.filters["estimate"][0, :4] = x
        self.filters["covariance"][0, :4, :4] = p

    @property
    def x(self) -> np.ndarray:
        return self.filters["estimate"][0, :4].copy()

    @property
    def p(self) -> np.ndarray:
        return self.filters["covariance"][0, :4, :4].copy()

    def predict(self, u: np.ndarray, row: Any) -> None:
        _predict(PAPER, self.filters, self.settings, row["airspeed_meas"], row["altitude_meas"], u)

    def correct(self, y: np.ndarray) -> None:
        s = self.settings[0]
        floor = s["effectiveness_floor"] if s["bounded"] else 0.0
        _update(self.filters, y, self.settings, float(floor))

    def step(self, u: np.ndarray, y: np.ndarray, row: Any) -> None:
        self.predict(u, row)
        self.correct(y)


@compiled
def _predict(model: Any, filters: Any, settings: Any, v: float, h: float, u: Any) -> None:
    s = settings[0]
    forcing = Forcing(u[0], u[1], u[2], False, 0.0, 0.0)
    at = at_condition(model[0], v, h)
    predict_unscented(filters[0], at, forcing, s.process_noise, s.spread, s.dt)


@compiled
def _update(filters: Any, y: Any, settings: Any, floor: float) -> None:
    s = settings[0]
    update(filters[0], y, s.measurement_noise, s.gate, s.gate_patience, floor)


@pytest.fixture
def at_20_s(flown):
    record = flown("paper").record
    u, y = inputs_and_measurements(record)
    return (
        Filter,
        np.array([record[1990][name] for name in ESTIMATES]),
        u[1990],
        y[1991],
        record[1991],
    )


def test_missing_measurement_is_skipped(at_20_s):
    """Nothing measured leaves the prediction as it is, and finite."""
    build, x, u, _, row = at_20_s
    one, other = build(x, P0), build(x, P0)
    one.predict(u, row)
    other.step(u, np.full(3, np.nan), row)
    np.testing.assert_array_equal(one.x, other.x)
    np.testing.assert_array_equal(one.p, other.p)


@pytest.mark.parametrize("silent", [0, 1, 2])
def test_silent_instrument_costs_itself_alone(at_20_s, silent):
    """The others correct as if the silent one had been read with an error of 1e9: to 1e-9 of each number."""
    build, x, u, y, row = at_20_s
    noise = np.diag(R).copy()
    noise[silent] = 1e18
    one, other = build(x, P0), build(x, P0)
    y = y + np.array([0.5, 0.01, 0.01])
    one.predict(u, row)
    update(one.filters[0], y, noise, 0.0, 0, 0.0)
    y[silent] = np.nan
    other.step(u, y, row)
    np.testing.assert_allclose(other.x, one.x, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(other.p, one.p, rtol=1e-6, atol=1e-15)


def test_gate_lets_one_outlier_pass_by_and_follows_a_jump(at_20_s):
    """A single airspeed 50 m/s off moves nothing; one that stays is believed after the patience."""
    build, x, u, _, row = at_20_s
    gated = build(x, P0, gate=True, gate_patience=5)
    truth = x
    errors = []
    for sample in range(500):
        truth = process(truth, u, row)
        jump = 50.0 if sample == 10 or sample >= 20 else 0.0
        gated.step(u, truth[:3] + np.array([jump, 0.0, 0.0]), row)
        errors.append(gated.x[0] - truth[0])
    assert np.abs(errors[:25]).max() < 0.01  # the outlier, and 5 samples of the jump
    assert errors[-1] == pytest.approx(50.0, abs=1.0)


def test_bounds_keep_the_estimate_between_sigma_and_one(at_20_s):
    """An airspeed that only less than no thrust could explain; bounded at sigma, unbounded below 0."""
    build, x, u, y, row = at_20_s
    bounded, free = build(x, P0, bounded=True), build(x, P0)
    for k in range(1, 200):
        falling = y - [0.2 * k, 0.0, 0.0]
        bounded.step(u, falling, row)
        free.step(u, falling, row)
        assert 0.05 <= bounded.x[3] <= 1.0
    assert free.x[3] < 0.0


def test_covariance_stays_symmetric_and_positive_definite(flown):
    """Over the whole flight with the fault in it, and the negative centre weight -1/3."""
    record = flown("paper").record
    u, y = inputs_and_measurements(record)
    filters = Filter(np.append(y[0], 1.0), P0)
    for i in range(1, record.size):
        filters.step(u[i - 1], y[i], record[i])
        p = filters.p
        np.testing.assert_array_equal(p, p.T)
        assert np.linalg.eigvalsh(p / np.sqrt(np.outer(np.diag(p), np.diag(p)))).min() > 0.0
