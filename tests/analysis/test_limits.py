"""Limits: the first sample outside, the worst value, and what is not recorded."""

import numpy as np

from ftc_jsb.analysis.limits import broken_limits
from ftc_jsb.recording.columns import ROW
from ftc_jsb.scenario.limits import Limits


def record():
    rows = np.full(101, np.nan).astype(ROW)
    rows["time"] = np.arange(101) / 10.0
    rows["airspeed"] = 300.0 - rows["time"]
    rows["airspeed_ref"] = 300.0
    return rows


def test_first_time_worst_value_and_bound_are_told():
    (broken,) = broken_limits(record(), Limits(airspeed=(295.0, 420.0)))
    assert (broken.name, broken.limit) == ("airspeed", 295.0)
    assert (broken.time, broken.value) == (5.1, 290.0)


def test_limits_come_in_the_order_of_time():
    names = [
        b.name for b in broken_limits(record(), Limits(airspeed=(295, 420), error_airspeed=(-2, 2)))
    ]
    assert names == ["error_airspeed", "airspeed"]


def test_variable_that_is_not_recorded_and_value_on_the_bound_break_nothing():
    assert broken_limits(record(), Limits(alpha_deg=(-1, 1), airspeed=(290.0, 300.0))) == []
