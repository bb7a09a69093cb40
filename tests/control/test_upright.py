"""The protected loop stays upright: the map from lift vector to bank and load factor, and flights of it."""

import math

import numpy as np
import pytest

from ftc_jsb.analysis.loss_of_control import inverted, loss_of_control
from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.control.upright import BANK_MAX, FLOOR, GLIDE_FLOOR, load_factor_at_bank, upright_bank

PUSHOVER = (
    "model=jsbsim",
    "initial.altitude=6000",
    "initial.airspeed=230",
    "initial.flight_path_deg=10",
    "reference.airspeed=[[0,230]]",
    "reference.heading_deg=[[0,0]]",
    "reference.flight_path_deg=[[0,10],[10,10],[14,0]]",
)


def test_bank_and_load_factor_give_the_wanted_lift_where_it_points_up():
    """For every c above FLOOR: n cos(mu) = c and n sin(mu) = s to rounding, whatever the share is."""
    for up in np.linspace(FLOOR, 8.0, 40):
        for across in np.linspace(-3.0 * up, 3.0 * up, 41):
            bank = upright_bank(up, across, FLOOR)
            for share in (0.0, 0.5, 1.0):
                n = load_factor_at_bank(up, across, bank, share)
                assert n * math.cos(bank) == pytest.approx(up, abs=1e-12)
                assert n * math.sin(bank) == pytest.approx(across, abs=1e-12)


def test_bank_is_continuous_and_below_90_degrees_in_the_whole_plane():
    """No sector of the (climb, turn) plane where the command jumps: 0.01 of lift is at most 2 deg."""
    grid = np.arange(-6.0, 6.0, 0.01)
    banks = np.array([[upright_bank(up, across, FLOOR) for across in grid[::5]] for up in grid])
    assert np.abs(banks).max() <= BANK_MAX
    assert np.abs(np.diff(banks, axis=0)).max() < math.radians(2.0)
    along = np.array([[upright_bank(up, across, FLOOR) for across in grid] for up in grid[::20]])
    assert np.abs(np.diff(along, axis=1)).max() < math.radians(2.0)


def test_push_is_flown_with_wings_level():
    assert upright_bank(-1.0, 0.0, FLOOR) == 0.0
    assert load_factor_at_bank(-1.0, 0.0, 0.0, 0.75) == -1.0


def test_pushover_ends_upright_where_the_law_alone_ends_on_its_back(flown):
    """F-16, healthy, still air, 10 deg of climb pushed to level: within 1 deg of path, bank below 10 deg.

    The law alone has two branches, and takes the other one; the verdict says so.
    """
    protected, law = flown("nominal", *PUSHOVER), flown("nominal", *PUSHOVER, "loop.name=law")
    assert not inverted(protected.record).any()
    assert np.degrees(np.abs(protected.record["bank_angle"])).max() < 10.0
    metrics = flight_metrics(protected)
    assert metrics["verdict"] == "inside limits"
    assert metrics["peak_error_flight_path_deg"] < 1.0
    lost = loss_of_control(law.record)
    assert lost is not None
    assert lost.kind == "inverted"
    assert flight_metrics(law)["verdict"] == "loss of control"
    assert flight_metrics(law)["inverted_time_s"] > 30.0


@pytest.mark.parametrize("aircraft", ["f16", "f15", "F4N", "A4", "T38"])
@pytest.mark.parametrize(
    ("path", "heading"),
    [
        ("[[0,0],[5,0],[8,-15]]", "[[0,0],[5,0],[10,60]]"),  # a bunt into a turn
        ("[[0,0],[5,0],[8,15],[12,15],[16,-10]]", "[[0,0]]"),  # over the top of a zoom
        ("[[0,0]]", "[[0,0],[5,0],[10,180]]"),  # a reversal
    ],
)
def test_fighters_stay_upright_and_in_control(flown, aircraft, path, heading):
    """Healthy, calm, at 7000 m, where the pressure is low and the F-15 rang before."""
    flight = flown(
        "nominal",
        "model=jsbsim",
        f"aircraft.name={aircraft}",
        "initial.altitude=7000",
        "initial.airspeed=230",
        "reference.airspeed=[[0,230]]",
        f"reference.flight_path_deg={path}",
        f"reference.heading_deg={heading}",
        "duration=40",
    )
    assert flight.outcome.status == "complete"
    assert not inverted(flight.record).any()
    assert loss_of_control(flight.record) is None
    assert np.degrees(np.abs(flight.record["sideslip"])).max() < 15.0


def test_a_push_is_no_steep_turn():
    """A push that halves the lift against gravity: a turn of 40 deg of bank becomes one of 54, not 59,
    and of 70 where almost nothing is left of it with the floor of a glide.
    """
    across = np.tan(np.radians(40.0))
    assert np.degrees(upright_bank(0.5, across, FLOOR)) == pytest.approx(54.4, abs=0.1)
    assert np.degrees(upright_bank(0.5, across, GLIDE_FLOOR)) == pytest.approx(59.2, abs=0.1)
    assert np.degrees(upright_bank(0.0, across, FLOOR)) == pytest.approx(54.4, abs=0.1)
    assert np.degrees(upright_bank(0.0, across, GLIDE_FLOOR)) == pytest.approx(70.3, abs=0.1)
