"""Speed first: what is given up, in which order, and nothing where thrust suffices."""

import math
from typing import Any

import numpy as np
import pytest

from ftc_jsb.analysis.metrics import flight_metrics
from ftc_jsb.compiled import compiled
from ftc_jsb.control.energy import Budget, payable_climb
from ftc_jsb.control.priority import DESCENT, SHALLOW, Request, affordable
from ftc_jsb.point_mass.dynamics import polar_drag
from ftc_jsb.point_mass.model import at_condition
from tests.point_mass.models import PAPER

WEIGHT = 14515.0 * 9.81  # [N]
FLIGHT = (300.0, 3048.0)  # [m/s], [m]


@compiled
def afford(model: Any, thrust: float, path: float, path_ref: float, turn: float) -> Any:
    at = at_condition(model[0], 300.0, 3048.0)
    return affordable(at, Budget(thrust, 0.0), 300.0, path, Request(path_ref, 0.0, 0.0, turn, 0.0))


@compiled
def climb_of(model: Any, thrust: float, load_factor: float) -> float:
    at = at_condition(model[0], 300.0, 3048.0)
    return payable_climb(at, Budget(thrust, 0.0), 300.0, load_factor, 0.0)


@compiled
def drag_of(model: Any, load_factor: float) -> float:
    return polar_drag(at_condition(model[0], 300.0, 3048.0), 300.0, 0.0, load_factor)[0]


def test_payable_climb_is_the_energy_balance():
    """sin(gamma) = (T - D) / W of Table 1's aircraft."""
    assert climb_of(PAPER, 80e3, 1.0) == pytest.approx((80e3 - drag_of(PAPER, 1.0)) / WEIGHT)


def test_nothing_is_given_up_where_thrust_suffices():
    assert afford(PAPER, 100e3, 0.05, 0.08, 0.05) == (0.08, 1.0)


def test_climb_goes_first_and_the_turn_stays():
    """53 kN at 300 m/s: level turns at 3 deg/s can be paid for, a climb of 5 deg besides cannot."""
    turn = math.radians(3.0)
    path, share = afford(PAPER, 53e3, 0.0, math.radians(5.0), turn)
    n = math.hypot(1.0, 300.0 / 9.81 * turn)
    assert share == 1.0
    assert 0.0 < path < math.radians(5.0)
    assert math.sin(path) == pytest.approx((53e3 - drag_of(PAPER, n)) / WEIGHT)


def test_turn_goes_next_and_is_as_tight_as_can_be_paid_for():
    """45 kN: a descent of 3 deg is kept, and the turn whose drag is just thrust and descent."""
    turn = math.radians(9.0)
    path, share = afford(PAPER, 45e3, 0.0, math.radians(5.0), turn)
    n = math.hypot(1.0, 300.0 / 9.81 * share * turn)
    assert path == -SHALLOW
    assert 0.0 < share < 1.0
    assert drag_of(PAPER, n) == pytest.approx(45e3 + WEIGHT * math.sin(SHALLOW), rel=1e-5)


def test_shallow_descent_pays_for_a_turn_that_level_flight_cannot():
    """45 kN: a turn of 6 deg/s stays whole, at the path whose energy balance it is."""
    turn = math.radians(6.0)
    path, share = afford(PAPER, 45e3, 0.0, math.radians(5.0), turn)
    n = math.hypot(1.0, 300.0 / 9.81 * turn)
    assert share == 1.0
    assert -SHALLOW < path < 0.0
    assert math.sin(path) == pytest.approx((45e3 - drag_of(PAPER, n)) / WEIGHT)


def test_height_goes_last():
    """10 kN hold 300 m/s only in a steeper descent, wings level; no thrust at all, down to 15 deg."""
    path, share = afford(PAPER, 10e3, 0.0, 0.0, 0.1)
    assert share == 0.0
    assert math.sin(path) == pytest.approx((10e3 - drag_of(PAPER, 1.0)) / WEIGHT)
    assert afford(PAPER, 0.0, 0.0, 0.0, 0.1)[0] == pytest.approx(
        max(-math.asin(drag_of(PAPER, 1.0) / WEIGHT), -DESCENT)
    )


def test_descent_that_is_asked_for_stays():
    """A reference of -10 deg is not raised, and its turn is paid for out of the height."""
    assert afford(PAPER, 45e3, -0.17, -0.17, 0.08) == (-0.17, 1.0)


@pytest.mark.parametrize("model", ["paper", "identified", "jsbsim"])
def test_airspeed_is_kept_where_the_law_alone_loses_it(flown, model):
    """0.3 of the thrust from 20 s: within 6 m/s, where path and heading first costs 24 to 32 m/s.

    Load factor and angle of attack stay inside the limits, and the recording tells what was given up.
    """
    speed = flown("speed-first", f"model={model}")
    law = flown("speed-first", f"model={model}", "loop.priority=none")
    kept, lost = flight_metrics(speed), flight_metrics(law)
    assert kept["limits_broken"] == []
    assert kept["peak_error_airspeed_mps"] < 6.0
    assert lost["peak_error_airspeed_mps"] > 20.0
    assert kept["peak_climb_given_up_deg"] > 5.0
    assert kept["peak_turn_given_up_deg_s"] > 5.0
    assert lost["peak_climb_given_up_deg"] == 0.0
    assert speed.record["load_factor"].min() > 0.2
    before = speed.record["time"] < 20.0
    assert np.all(speed.record["climb_given_up"][before] == 0.0)


@pytest.mark.parametrize("model", ["paper", "jsbsim"])
def test_priority_changes_nothing_where_the_thrust_suffices(flown, model):
    one = flown("paper", f"model={model}").record
    other = flown("paper", f"model={model}", "loop.priority=none").record
    for name in ("airspeed", "load_factor_cmd", "bank_angle_cmd", "thrust_cmd"):
        np.testing.assert_array_equal(one[name], other[name])


def test_a_short_want_of_thrust_is_paid_from_the_reserve_of_airspeed(flown):
    """0.45 of the F-16's thrust from 20 s: it is too little for the climbing turn alone. With 5 m/s to be spent
    the flight stays inside its limits; with none of it the path is given up by 6 deg. Nothing is spent where
    thrust suffices, and never more than the reserve by more than the lag costs.
    """
    given = ("model=identified", "loop.name=robust", "fault[0].effectiveness=0.45")
    spending, keeping = (
        flight_metrics(flown("paper", *given, *more)) for more in ((), ("loop.airspeed_reserve=0",))
    )
    assert spending["verdict"] == "inside limits"
    assert spending["peak_error_airspeed_mps"] < 6.0
    assert spending["peak_error_flight_path_deg"] < 2.5
    assert keeping["peak_error_airspeed_mps"] < 2.0
    assert keeping["peak_error_flight_path_deg"] > 5.0
    enough = ("model=identified", "loop.name=robust", "fault[0].effectiveness=0.6")
    one, other = (
        flown("paper", *enough, *more).record for more in ((), ("loop.airspeed_reserve=0",))
    )
    np.testing.assert_array_equal(one["thrust_cmd"], other["thrust_cmd"])
