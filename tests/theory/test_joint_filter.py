"""The filter for any system against the augmented form as printed: linear and nonlinear outputs."""

import numpy as np
import pytest

from ftc_jsb.estimation.augmented import augmented_step
from ftc_jsb.theory.generated import generate
from ftc_jsb.theory.kernels.joint_filter import (
    INNOVATION_NOT_DEFINITE,
    SOUND,
    FilterSettings,
)
from ftc_jsb.theory.linearization import linearize
from ftc_jsb.theory.system import System
from ftc_jsb.theory.systems import fighter_by_position, fighter_by_velocity

DT = 0.01


def compare(system: System, start: np.ndarray, q: np.ndarray, r: np.ndarray, observe):
    """Largest differences, in standard deviations, of 200 steps of both forms from the same start."""
    kernels = generate(linearize(system))
    n = len(start)
    settings = FilterSettings(q, r, spread=3.0, floor=0.0, dt=DT, extended=False)
    propagate = kernels.propagate
    scratch = np.zeros((5, n))
    p = kernels.parameters
    random = np.random.default_rng(5)
    truth = start.copy()
    z, cov = np.concatenate([start, np.ones(3)]), np.diag(np.concatenate([q[:n] * 1e4, [1e-4] * 3]))
    worst = 0.0

    def process(point):
        x = point[:n].copy()
        propagate(False, x, u, point[n:], p, DT, scratch)
        return np.concatenate([x, point[n:]])

    for i in range(200):
        u = np.array([60e3, 1.5 + 0.5 * np.sin(0.1 * i), 0.6 * np.sin(0.05 * i)])
        propagate(False, truth, u, np.array([0.8, 1.0, 1.0]), p, DT, scratch)
        y = observe(truth) + random.standard_normal(3) * np.sqrt(r)
        x_aug, cov_aug = augmented_step(process, observe, z, cov, np.diag(np.append(q, r)), y)
        assert kernels.estimate(z, cov, u, y, p, settings) == SOUND
        deviation = np.sqrt(np.diag(cov_aug))
        worst = max(worst, np.abs((z - x_aug) / deviation).max())
    return worst


def test_both_forms_are_equal_for_linear_outputs():
    """Fighter, y = x: equal to rounding, 1e-6 standard deviations."""
    q = np.array([1e-6, 1e-10, 1e-10, 1e-8, 1e-8, 1e-8])
    r = np.array([1e-4, 1e-8, 1e-8])
    worst = compare(fighter_by_velocity(), np.array([300.0, 0.0, 0.0]), q, r, lambda x: x[:3])
    assert worst < 1e-6


def test_forms_differ_little_for_nonlinear_outputs():
    """Fighter, measured by range, and two bearings from the origin: they differ, by less than 0.1 sigma."""
    import sympy as sp

    base = fighter_by_position()
    north, east, up = base.outputs
    distance = sp.sqrt(north**2 + east**2 + up**2)
    seen = (distance, sp.atan2(east, north), up / distance)
    system = System(
        "fighter_by_radar", base.states, base.inputs, base.parameters, base.dynamics, seen
    )

    def observe(x):
        distance = np.sqrt(x[3] ** 2 + x[4] ** 2 + x[5] ** 2)
        return np.array([distance, np.arctan2(x[4], x[3]), x[5] / distance])

    q = np.array([1e-4, 1e-6, 1e-6, 1e-2, 1e-2, 1e-2, 1e-8, 1e-8, 1e-8])
    start = np.array([300.0, 0.1, 0.2, 800.0, 300.0, 700.0])
    worst = compare(system, start, q, np.array([1.0, 1e-4, 1e-4]), observe)
    assert 1e-9 < worst < 0.1


def test_position_outputs_are_linear_in_the_state_and_so_equal():
    q = np.array([1e-6, 1e-10, 1e-10, 1e-4, 1e-4, 1e-4, 1e-8, 1e-8, 1e-8])
    start = np.array([300.0, 0.0, 0.0, 0.0, 0.0, 3048.0])
    worst = compare(fighter_by_position(), start, q, np.array([1e-2] * 3), lambda x: x[3:6])
    assert worst == pytest.approx(0.0, abs=1e-6)


def test_five_states_and_a_range_keep_their_covariance():
    """A spread of 3 over 6 states has a centre weight of -1, and a range seen from near by makes
    P_yy + R negative, by hand -3.3: that is said. The loop's own spread is sound.
    """
    import sympy as sp

    x = sp.symbols("x1:6", real=True)
    u = sp.Symbol("u", real=True)
    distance = sp.sqrt(sum(element**2 for element in x) + sp.Rational(1, 10**6))
    rates = (x[1], sp.sinh(u), -x[2], -x[3], -x[4])
    kernels = generate(linearize(System("near", x, (u,), {}, rates, (x[0],), (distance,))))
    noise = np.full(6, 1e-4)
    settings = FilterSettings(noise, np.array([1e-6]), 3.0, 0.0, DT, extended=False)
    y, arguments = np.array([0.1]), (kernels.parameters, settings)
    status = kernels.estimate(np.zeros(6), np.eye(6), np.zeros(1), y, *arguments)
    assert status == INNOVATION_NOT_DEFINITE
    z, covariance = np.zeros(6), np.eye(6)
    for _ in range(200):
        sound = settings._replace(spread=6.0)
        status = kernels.estimate(z, covariance, np.zeros(1), y, kernels.parameters, sound)
        assert status == SOUND
    assert np.abs(z).max() < 3.0
    assert np.linalg.eigvalsh(covariance).min() > 0.0


def test_literal_form_has_the_cross_covariance_of_25():
    """P_vxi in the augmented covariance, a linear system: the Kalman filter for correlated noise, 1e-12.

    P_yy gains H P_vxi + P_xiv H^T and P_xy gains P_vxi, since the noise of the step enters both.
    """
    random = np.random.default_rng(3)
    f, h = random.standard_normal((3, 3)), random.standard_normal((2, 3))
    root = random.standard_normal((5, 5))
    noise = root @ root.T
    q, cross, r = noise[:3, :3], noise[:3, 3:], noise[3:, 3:]
    x, p, y = random.standard_normal(3), np.diag([1.0, 2.0, 3.0]), random.standard_normal(2)
    found, covariance = augmented_step(lambda z: f @ z, lambda z: h @ z, x, p, noise, y)
    ahead = f @ p @ f.T + q
    pyy = h @ ahead @ h.T + r + h @ cross + cross.T @ h.T
    gain = (ahead @ h.T + cross) @ np.linalg.inv(pyy)
    np.testing.assert_allclose(found, f @ x + gain @ (y - h @ f @ x), atol=1e-10)
    np.testing.assert_allclose(covariance, ahead - gain @ pyy @ gain.T, atol=1e-10)


def pass_beacon(kernels, extended, deviation, seed):
    """Errors of the position along 4 s past a beacon at a distance of 1 m, 1 m/s, ranges to 1 mm."""
    random = np.random.default_rng(seed)
    noise, dt = np.full(3, 1e-6), 0.05
    settings = FilterSettings(noise, np.array([1e-6]), 3.0, 0.0, dt, extended)
    truth = np.array([-2.0, 1.0]) + random.standard_normal(2) * [deviation, 0.1]
    z, covariance = np.array([-2.0, 1.0, 0.8]), np.diag([deviation**2, 1e-2, 1e-2])
    z[2] += 0.1 * random.standard_normal()
    scratch, errors = np.zeros((5, 2)), []
    for i in range(80):
        u = np.array([0.3 * np.sin(0.025 * i)])
        kernels.propagate(False, truth, u, np.array([0.8]), kernels.parameters, dt, scratch)
        truth += random.standard_normal(2) * 1e-3
        y = np.array([np.hypot(truth[0], 1.0) + 1e-3 * random.standard_normal()])
        assert kernels.estimate(z, covariance, u, y, kernels.parameters, settings) == SOUND
        errors.append(z[0] - truth[0])
    return errors


def test_extended_and_unscented_filters_part_where_the_output_bends_within_sigma():
    """200 seeds. Known to 0.1 m at the start both have the same RMS error, within 1 %; known to 0.5 m the
    range bends by far more than its noise within a deviation, and the EKF's is more than twice the UKF's.
    """
    import sympy as sp

    x1, x2, u = sp.symbols("x1 x2 u", real=True)
    rates = (x2, u + u**3 / 10)
    seen = (sp.sqrt(x1**2 + 1),)
    kernels = generate(linearize(System("beacon", (x1, x2), (u,), {}, rates, (x1,), seen)))
    rms = {
        (extended, deviation): np.sqrt(
            np.mean([np.square(pass_beacon(kernels, extended, deviation, s)) for s in range(200)])
        )
        for extended in (False, True)
        for deviation in (0.1, 0.5)
    }
    assert rms[True, 0.1] == pytest.approx(rms[False, 0.1], rel=0.01)
    assert rms[True, 0.5] > 2.0 * rms[False, 0.5]
