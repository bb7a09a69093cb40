"""The fits recover what is known, and the shipped point mass tells an unseen flight."""

import numpy as np
import pytest

from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.aircraft.dynamic_pressure import pressure_area
from ftc_jsb.aircraft.point_mass_file import load_point_mass
from ftc_jsb.identify.flight_test import fly_manoeuvre
from ftc_jsb.identify.inner_loop_lag import fit_lag, second_order
from ftc_jsb.identify.knots import at_most, mach_knots
from ftc_jsb.identify.manoeuvres import held_out
from ftc_jsb.identify.polar import fit_alpha, fit_polar
from ftc_jsb.identify.regression import hats, second_differences, solve
from ftc_jsb.identify.samples import Samples, relative_residual
from ftc_jsb.point_mass.atmosphere import standard_atmosphere
from ftc_jsb.point_mass.drag import measured_drag_coefficient
from ftc_jsb.recording.columns import ROW
from tests.point_mass.models import polar_and_alpha

F16 = load_aircraft("f16")


def synthetic(random: np.random.Generator, count: int, inside: float = 0.0) -> Samples:
    lift = random.uniform(-0.2 + inside, 0.9 - inside, count)
    mach = random.uniform(0.5 + inside, 1.1 - inside, count)
    drag = 0.02 + 0.01 * (mach - 0.5) + 0.1 * lift**2
    zero = np.zeros(count)
    angles = 0.02 + 0.25 * lift
    return Samples(lift, drag, mach, angles, *(zero,) * 10, np.ones(count))


def test_polar_and_alpha_of_a_known_aircraft_are_recovered():
    """A parabola with a drag rise: 1e-3 relative on samples that were not fitted,
    inside the outermost knots.
    """
    random = np.random.default_rng(1)
    data, check = synthetic(random, 20000), synthetic(random, 2000, inside=0.06)
    polar = fit_polar(data, ())
    assert np.abs(relative_residual(polar.predict(check), check)).max() < 1e-3
    alpha = fit_alpha(data, polar.mach)
    np.testing.assert_allclose(alpha[3], [0.02, 0.25, 0.0, 0.0], atol=1e-3)


def test_knots_come_in_pairs_where_flaps_switch():
    knots = mach_knots(np.linspace(0.8, 1.0, 1000), (0.9,))
    assert np.min(np.diff(knots)) == pytest.approx(0.004)
    assert np.all(np.diff(knots) > 0.0)


def test_knots_are_never_more_than_the_kernels_hold():
    """From Mach 0.1 to 1.9 by 0.025 there would be 73; a range narrower than a step has its ends."""
    values = np.linspace(0.1, 1.9, 2000)
    assert len(mach_knots(values, (0.9,), 0.025)) > 40
    knots = at_most(40, lambda step: mach_knots(values, (0.9,), step), 0.025)
    assert 20 < len(knots) <= 40
    assert np.min(np.abs(knots - 0.902)) < 1e-9
    narrow = mach_knots(np.linspace(0.31, 0.34, 100), ())
    assert np.all(np.diff(narrow) > 0.0)
    assert len(narrow) == 2


def test_hats_interpolate_and_smoothness_fills_a_gap():
    """A knot without a single sample lies on the line of its neighbours."""
    knots = np.arange(6.0)
    x = np.concatenate([np.linspace(0, 2, 50), np.linspace(4, 5, 50)])
    value = solve(hats(x, knots), 3.0 * x, np.ones(100), [1e-6 * second_differences(6, 1)])
    np.testing.assert_allclose(value, 3.0 * knots, atol=1e-3)


def test_lag_with_limits_is_recovered():
    """5 rad/s, damping 0.8, 1 rad/s and 6 rad/s2 from a flight of steps: 2 % each."""
    record = np.zeros(4000, ROW)
    record["bank_angle_cmd"] = np.repeat(np.random.default_rng(2).uniform(-1, 1, 20), 200)
    record["bank_angle_cmd"][:200] = 0.0
    record["bank_angle"] = second_order(record["bank_angle_cmd"], 5.0, 0.8, 1.0, 6.0, 0.01)
    lag = fit_lag([record], "bank_angle", 0.01, limited=True)
    assert lag[:4] == pytest.approx((5.0, 0.8, 1.0, 6.0), rel=0.02)
    assert lag.residual < 1e-3


def test_shipped_point_mass_tells_the_drag_of_an_unseen_flight():
    """One held-out flight: drag from measured angles within 1 % RMS, and the file says how well."""
    shipped = load_point_mass(F16.folder)
    model = shipped.record(0.43)
    manoeuvre = next(iter(held_out(F16.flight_test)))
    record = fly_manoeuvre(F16, manoeuvre, shipped.aerodynamics.area)
    assert record is not None
    errors = []
    for row in record[50::20]:
        density, _ = standard_atmosphere(row["altitude"])
        force = pressure_area(density, row["airspeed"], shipped.aerodynamics.area)
        coefficient = measured_drag_coefficient(
            model[0], row["mach"], row["alpha"], row["sideslip"], row["elevator"], row["flap"],
            row["pitch_rate"] / row["airspeed"],
        )  # fmt: skip
        errors.append(coefficient * force / row["drag"] - 1.0)
    assert np.sqrt(np.mean(np.square(errors))) < 0.01
    told = shipped.identification
    assert told["residual_drag_polar_percent"] <= 1.5
    assert told["residual_drag_angles_percent"] <= 0.3
    assert {"date", "jsbsim", "flights", "flights_held_out"} <= set(told)
    assert shipped.valid is not None


def test_shipped_point_mass_is_an_aircraft_everywhere_in_its_range():
    """Over the whole box of Mach and C_L that the file calls valid: drag above zero, alpha rising with C_L.

    Corners of the box that no flight reaches are extrapolated; they must still be flyable.
    """
    shipped = load_point_mass(F16.folder)
    assert shipped.valid is not None
    model = shipped.record(0.43)
    (low, high), (least, most) = shipped.valid.mach, shipped.valid.lift_coefficient
    for mach in np.linspace(low, high, 40):
        airspeed = mach * 328.58  # [m/s], speed of sound at 3048 m
        values = np.array(
            [
                polar_and_alpha(model, airspeed, 3048.0, lift)
                for lift in np.linspace(least, most, 60)
            ]
        )
        assert values[:, 0].min() > 0.015
        assert np.diff(values[:, 1]).min() > 0.0
