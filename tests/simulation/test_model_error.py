"""[model_error]: the loop counts on a wrong model, the aircraft that flies stays what it is."""

import numpy as np
import pytest

from ftc_jsb.simulation.assembly import point_mass_of

LEVEL = (
    "duration=10",
    "reference.heading_deg=[[0,0]]",
    "reference.flight_path_deg=[[0,0]]",
    "fault=[]",
)


def test_the_loop_counts_on_the_factors(flown):
    right = flown("nominal", *LEVEL)
    wrong = flown(
        "nominal", *LEVEL, "model_error.mass=1.1", "model_error.drag=1.2", "model_error.thrust=0.9"
    )
    one, other = (point_mass_of(flight.scenario).record(0.4)[0] for flight in (right, wrong))
    assert other["mass"] == pytest.approx(1.1 * one["mass"], rel=1e-12)
    assert np.allclose(other["drag"], 1.2 * one["drag"], rtol=1e-12)
    assert np.allclose(other["thrust_maximum"], 0.9 * one["thrust_maximum"], rtol=1e-12)
    assert wrong.record["mass"][0] == right.record["mass"][0]
    assert wrong.record["drag"][0] == right.record["drag"][0]


def test_drag_that_is_believed_larger_looks_like_effectiveness(flown):
    """In level flight at constant speed the filter explains thrust = drag by k T = f D: k = 1.2 within 1 %,
    where the paper's filter is free above 1.
    """
    wrong = flown("nominal", *LEVEL, "model_error.drag=1.2")
    assert wrong.record["effectiveness_thrust_est"][-1] == pytest.approx(1.2, abs=0.012)


def test_jsbsim_flies_with_a_loop_that_is_wrong_about_its_mass(flown):
    """The aircraft is still its own, its commands are others."""
    wrong = flown("nominal", *LEVEL, "model='jsbsim'", "model_error.mass=1.3")
    right = flown("nominal", *LEVEL, "model='jsbsim'")
    assert wrong.outcome.status == "complete"
    assert wrong.record["mass"][0] == right.record["mass"][0]
    assert not np.array_equal(wrong.record["thrust_cmd"], right.record["thrust_cmd"])
