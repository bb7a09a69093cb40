"""What the protected loop refuses to fly: into the ground, too fast, too slow."""

import numpy as np
import pytest


@pytest.mark.parametrize("model", ["identified", "jsbsim"])
def test_dive_is_ended_above_the_ground(flown, model):
    """A reference of -25 deg held from 2500 m: the flight levels out above 100 m and stays there."""
    flight = flown(
        "nominal",
        f"model={model}",
        "initial.altitude=2500",
        "initial.airspeed=230",
        "reference.airspeed=[[0,230]]",
        "reference.heading_deg=[[0,0]]",
        "reference.flight_path_deg=[[0,0],[5,0],[12,-25]]",
    )
    assert flight.outcome.status == "complete"
    assert flight.record["altitude"].min() > 100.0
    assert np.degrees(np.abs(flight.record["flight_path_angle"][-500:])).max() < 1.0


def test_airspeed_stays_inside_the_range_of_the_fit(flown):
    """References of 450 m/s and of 60 m/s: never beyond the fitted Mach number, never stalled."""
    fast = flown("nominal", "model=jsbsim", "reference.airspeed=[[0,300],[5,450]]")
    assert fast.outcome.status == "complete"
    assert fast.record["mach"].max() < 1.11
    slow = flown("nominal", "model=jsbsim", "reference.airspeed=[[0,300],[60,60]]", "duration=120")
    assert slow.outcome.status == "complete"
    assert np.degrees(slow.record["alpha"].max()) < 30.0
