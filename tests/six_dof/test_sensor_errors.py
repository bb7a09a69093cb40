"""The inner loop reads its sensors: the same flight with perfect ones, other flights with faulty ones."""

import numpy as np
import pytest

from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly

SHORT = ("model=jsbsim", "duration=20", "fault=[]")


def flown(*overrides: str):
    return fly(load_scenario("paper", [*SHORT, *overrides])).record


def test_perfect_sensors_are_the_truth():
    """The woven sums change nothing but the last bits: 1e-6 m/s, 1e-8 rad."""
    truth, measured = flown(), flown("sensors.inner_loop=true")
    assert measured["airspeed"] == pytest.approx(truth["airspeed"], abs=1e-6)
    assert measured["bank_angle"] == pytest.approx(truth["bank_angle"], abs=1e-8)


def test_vane_that_is_off_reaches_the_airframe():
    """A sideslip vane 2 deg off: the inner loop flies 2 deg of sideslip, within 0.3; otherwise none."""
    fault = 'fault=[{target="sideslip",kind="bias",size_deg=2.0,start=5}]'
    straight = ("reference.heading_deg=[[0,0]]", fault)
    slips = np.degrees(flown(*straight, "sensors.inner_loop=true")["sideslip"][-1])
    assert slips == pytest.approx(-2.0, abs=0.3)
    assert abs(np.degrees(flown(*straight)["sideslip"][-1])) < 0.05


def test_silent_gyro_leaves_its_last_reading():
    """A pitch gyro silent from 5 s on: held, so the airframe feels it; finite all the way."""
    record = flown(
        'fault=[{target="pitch_rate",kind="dropout",start=5}]', "sensors.inner_loop=true"
    )
    assert np.all(np.isfinite(record["pitch"]))
    assert not np.array_equal(record["pitch"], flown()["pitch"])


@pytest.mark.parametrize(
    ("given", "reaches"),
    [((), False), (("sensors.profile=tactical",), True),
     (("sensors.profile=tactical", "sensors.inner_loop=false"), False)],
)  # fmt: skip
def test_default_is_by_the_profile(given, reaches):
    assert load_scenario("paper", given).sensors.reach_inner_loop == reaches
