"""Loss of control on recordings made by hand: when it begins, and as what."""

import numpy as np
import pytest

from ftc_jsb.analysis.loss_of_control import loss_of_control
from ftc_jsb.recording.columns import ROW


def recording(**columns):
    record = np.zeros(6001, ROW)
    record["time"] = np.arange(6001) / 100.0
    record["airspeed"] = record["airspeed_ref"] = 200.0
    for name, values in columns.items():
        record[name] = values
    return record


TIME = recording()["time"]


def test_level_flight_has_none():
    assert loss_of_control(recording()) is None


def test_inverted_counts_after_three_tenths_of_a_second_and_from_its_first_sample():
    """A bank of 120 deg for 0.2 s is none, for 2 s it is, from the time at which it began."""
    short = np.where((TIME >= 10.0) & (TIME < 10.2), 2.1, 0.0)
    assert loss_of_control(recording(bank_angle=short)) is None
    lasting = np.where((TIME >= 10.0) & (TIME < 12.0), 2.1, 0.0)
    assert loss_of_control(recording(bank_angle=lasting)) == (10.0, "inverted")


def test_full_turns_of_bank_are_upright():
    assert loss_of_control(recording(bank_angle=2.0 * np.pi * 3.0)) is None


@pytest.mark.parametrize(("thrust", "lost"), [(0.0, False), (80e3, True)])
def test_too_fast_at_idle_is_a_dive_and_at_full_thrust_is_none(thrust, lost):
    """4 m/s faster every second on the path asked for: what idle cannot hold, or a loop gone wrong."""
    away = recording(
        airspeed=200.0 + np.maximum(4.0 * (TIME - 10.0), 0.0),
        thrust_saturated=1.0,
        thrust_cmd=thrust,
        drag=40e3,
    )
    assert (loss_of_control(away) is not None) == lost


@pytest.mark.parametrize(
    ("column", "value", "kind"),
    [
        ("alpha", 0.8, "angle of attack"),
        ("sideslip", -0.5, "sideslip"),
        ("roll_rate", 6.0, "body rates"),
    ],
)
def test_departure_is_an_angle_or_a_rate_beyond_the_airframe(column, value, kind):
    found = loss_of_control(recording(**{column: np.where(TIME >= 20.0, value, 0.0)}))
    assert found == (20.0, kind)


def test_error_that_grows_without_end_is_lost_and_a_commanded_jump_is_not():
    """Airspeed falling by 2 m/s a second, and a heading reference that jumps by 180 deg and is reached."""
    falling = loss_of_control(recording(airspeed=200.0 - 2.0 * TIME))
    assert falling is not None
    assert falling.kind == "airspeed diverges"
    assert falling.time == pytest.approx(30.0, abs=0.1)  # 60 m/s of 200
    closing = np.pi * np.exp(-TIME / 10.0)
    assert loss_of_control(recording(heading=closing)) is None
