"""The textbook plant flown with a loss of effectiveness, the proof's bound, and zeta to infinity."""

import itertools

import numpy as np
import pytest

from ftc_jsb.errors import TheoryError
from ftc_jsb.theory.closed_loop import ClosedLoop, Conditions, Settings
from ftc_jsb.theory.gains import given_gains, placed_gains
from ftc_jsb.theory.linearization import linearize
from ftc_jsb.theory.system import System
from ftc_jsb.theory.systems import textbook_plant
from ftc_jsb.theory.trim_filter import trim_step_second_order

SETTINGS = Settings(
    dt=0.005,
    zeta=50.0,
    process_noise=np.array([1e-10, 1e-10, 1e-6]),
    measurement_noise=np.array([1e-8]),
    initial_covariance=np.array([1e-6, 1e-6, 1e-4]),
)


def reference(t):
    return np.array([0.5 * np.sin(t), 0.5 * np.cos(t)]), np.array([-0.5 * np.sin(t)])


def loss(t):
    return np.array([0.7 if t >= 5.0 else 1.0])


@pytest.fixture(scope="module")
def loop():
    linear = linearize(textbook_plant())
    a, b, _ = linear.brunovsky()
    return ClosedLoop(linear, placed_gains(a, b, np.array([-2.0, -3.0])))


FLIGHT = (reference, loss, np.array([0.2, 0.5]), np.array([0.5]), 20.0)


def test_textbook_plant_is_tracked_through_a_loss(loop):
    """Only x1 is measured; k falls to 0.7 at 5 s. Estimate within 0.01
    after 1 s, error below 1e-3 after 5 s.
    """
    history = loop.fly(*FLIGHT, SETTINGS)
    late = history.time > 6.0
    assert np.abs(history.estimate[late, 2] - 0.7).max() < 0.01
    assert np.abs(history.error[history.time > 10.0]).max() < 1e-3


def test_remainder_goes_to_zero_with_zeta(loop):
    """Lim zeta -> infinity of (10): the largest |u - u_n| in quiet flight, told the truth, falls with
    each step up of zeta, and the tracking error that O(.) makes with it.
    """
    steps, errors = [], []
    for zeta in (5.0, 10.0, 20.0, 50.0, 100.0):
        history = loop.fly(*FLIGHT, SETTINGS._replace(loop="oracle", zeta=zeta))
        late = history.time > 10.0
        steps.append(np.abs(history.command - history.trim)[late].max())
        errors.append(np.abs(history.error[late]).max())
    assert all(later < earlier for earlier, later in itertools.pairwise(steps))
    assert steps[-1] < 1.5 * 5.0 / 100.0 * steps[0]  # as 1 / zeta
    assert errors[-1] < errors[0]


def test_trim_input_follows_the_input_that_solves_the_exact_equation(loop):
    """u_n' = zeta (u - u_n) is Newton's iteration: with u* of alpha(x, u*) = y_m'' - K e and delta = u_n - u*,
    |delta| <= |delta(0)| exp(-zeta t) + sup|du*/dt| / zeta, in samples |Delta u*| / (1 - exp(-zeta dt)).
    Newton's own second order adds to it where delta is large, at most a tenth of the first term here.
    """
    from scipy.optimize import brentq

    history = loop.fly(reference, lambda t: np.ones(1), FLIGHT[2], np.array([1.4]), 4.0,
                       SETTINGS._replace(loop="oracle"))  # fmt: skip
    demand = history.derivative[:, 0] - history.error @ loop.gains.k[0]

    def exact(u, x, wanted):
        return x[0] ** 2 + 0.15 * u**3 + 0.1 * (1 + x[1] ** 2) * u + np.sin(0.1 * u) - wanted

    solved = np.array(
        [brentq(exact, -9, 9, (x, w)) for x, w in zip(history.state, demand, strict=True)]
    )
    distance = np.abs(history.trim[:, 0] - solved)
    fastest = np.abs(np.diff(solved)).max() / (1.0 - np.exp(-SETTINGS.zeta * SETTINGS.dt))
    bound = 1.1 * distance[0] * np.exp(-SETTINGS.zeta * history.time) + fastest
    assert distance[0] > 0.5
    assert np.all(distance <= bound)
    assert distance[200:].max() > 0.05 * fastest  # the second term is no idle one


def test_singular_point_and_departure_are_errors_with_a_place(loop):
    """K = 0 with exact knowledge: the law's own floor keeps G regular, the plant goes its way."""
    with pytest.raises(TheoryError, match=r"not finite at .* outside the ranges .* since 0\.000 s"):
        loop.fly(
            lambda t: (np.array([5.0, 0.0]), np.zeros(1)), lambda t: np.zeros(1),
            np.array([3.0, 3.0]), np.array([0.5]), 20.0, SETTINGS,
        )  # fmt: skip


def test_filters_of_second_order_follow_a_step_without_overshoot():
    """Remark 5: another filter in place of (10); exact, monotonic, and there after 10 / zeta."""
    u_n, rate, u = np.zeros(1), np.zeros(1), np.ones(1)
    path = []
    for _ in range(100):
        trim_step_second_order(u_n, rate, u, 20.0, 0.01)
        path.append(u_n[0])
    time = 20.0 * 0.01 * np.arange(1, 101)
    np.testing.assert_allclose(path, 1.0 - (1.0 + time) * np.exp(-time), atol=1e-12)


def test_gain_that_is_not_hurwitz_never_flies():
    linear = linearize(textbook_plant())
    a, b, _ = linear.brunovsky()
    with pytest.raises(TheoryError, match="not Hurwitz"):
        ClosedLoop(linear, given_gains(a, b, np.array([[1.0, -1.0]])))


def test_covariance_that_fails_is_an_error_with_its_time(loop):
    with pytest.raises(
        TheoryError, match=r"covariance of the innovation is not positive .* 0\.005 s"
    ):
        loop.fly(*FLIGHT, SETTINGS._replace(measurement_noise=np.array([-1.0])))


def test_conditions_of_a_flight_are_met(loop):
    """Limits and rates hold the command, a lag delays it, noise follows the seed, lost samples are
    left out, a stuck input stays; without FTC the error after the loss is far larger.
    """
    flights = {name: loop.fly(*FLIGHT, SETTINGS._replace(loop=name)) for name in ("ftc", "no-ftc")}
    late = flights["ftc"].time > 10.0
    with_it, without = (np.abs(flights[name].error[late]).max() for name in ("ftc", "no-ftc"))
    assert with_it < 0.05 * without
    limits = Conditions(low=np.array([-2.05]), high=np.array([2.05]), rate=np.array([20.0]))
    held = loop.fly(reference, loss, np.array([0.0, 0.5]), np.zeros(1), 20.0, SETTINGS, limits)
    assert np.abs(held.command).max() <= 2.05
    assert np.abs(np.diff(held.command[:, 0])).max() <= 20.0 * SETTINGS.dt * (1 + 1e-9)
    assert not np.array_equal(held.command, held.wanted)
    lagging = loop.fly(*FLIGHT, SETTINGS, Conditions(lag=np.array([0.05])))
    assert not np.allclose(lagging.delivered, lagging.command * lagging.effectiveness, atol=1e-3)
    noisy = [
        loop.fly(*FLIGHT, SETTINGS, Conditions(sensor_noise=np.array([1e-5]), seed=seed))
        for seed in (1, 1, 2)
    ]
    np.testing.assert_array_equal(noisy[0].state, noisy[1].state)
    assert not np.array_equal(noisy[0].state, noisy[2].state)
    lost = Conditions(sensor=lambda t: np.array([np.nan if 8.0 < t < 8.2 else 0.0]))
    history = loop.fly(*FLIGHT, SETTINGS, lost)
    assert np.isnan(history.measured).any()
    assert np.abs(history.error[history.time > 12.0]).max() < 1e-2
    stuck = Conditions(held=lambda t: np.array([0.3 if t > 15.0 else np.nan]))
    history = loop.fly(reference, loss, FLIGHT[2], FLIGHT[3], 16.0, SETTINGS, stuck)
    assert (history.delivered[history.time > 15.01] == 0.3).all()


def test_plant_may_be_another_system_than_the_model(loop):
    """A gain that is 10 % less in the plant is taken for a loss of effectiveness of about that."""
    model = textbook_plant()
    x1, x2 = model.states
    rate = model.dynamics[1] - x1**2 / 20  # structure differs in the drift
    plant = System("other", model.states, model.inputs, {}, (x2, rate), model.outputs)
    other = ClosedLoop(loop.linearization, loop.gains, plant)
    error = np.abs(other.fly(*FLIGHT, SETTINGS).error[2500:]).max()
    assert 1e-4 < error < 0.05
