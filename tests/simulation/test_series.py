"""Flights of a series are those of `fly`, to the bit, whatever was flown before them in the same memory."""

import pytest

from ftc_jsb.errors import ScenarioError
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from ftc_jsb.simulation.series import Series

FLOWN = (  # longer and shorter ones, with and without an estimate, one that departs, two engines, other rates
    ["duration=8"],
    ["duration=6", "loop.name='integral'", "wind.turbulence='moderate'", "seed=4"],
    ["duration=30", "initial.altitude=100", "reference.flight_path_deg=[[0.0, -20.0]]"],
    ["duration=5", "model='identified'", "aircraft.name='f15'", "initial.airspeed=250"],
    ["duration=7", "loop.name='robust'", "sensors.profile='tactical'", "loop.rate=50", "seed=2"],
    ["duration=1", "loop.name='tests.control.my_loop:PullingLoop'"],
    ["duration=0.5", "model='jsbsim'"],
    ["duration=8"],
)


def test_flights_of_a_series_are_those_of_fly():
    series = Series()
    departed = 0
    for changes in FLOWN:
        scenario = load_scenario("paper", changes)
        one, other = series.fly(scenario), fly(scenario)
        assert one.outcome == other.outcome, changes
        assert one.record.tobytes() == other.record.tobytes(), changes
        departed += one.outcome.status == "departed"
    assert departed == 1


def test_a_fault_that_a_point_mass_cannot_have_is_refused():
    scenario = load_scenario("paper", ["fault[0].target='elevator'"])
    with pytest.raises(ScenarioError, match="'jsbsim' has"):
        Series().fly(scenario)
