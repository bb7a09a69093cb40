"""Inner-loop response and model residuals: exact where the answer is known, small where it was identified."""

import numpy as np
import pytest

from ftc_jsb.analysis.command_following import command_following_metrics
from ftc_jsb.analysis.model_residuals import flight_residuals, residual_metrics


def test_delay_is_the_shift_of_the_command(flown):
    """Bank made the command of 0.25 s ago: RMS as it comes, delay 0.25 s less the sample it acts in."""
    flight = flown("paper", "model=identified")
    record = flight.record.copy()
    shift = 25  # samples of 0.01 s
    record["bank_angle"][shift:] = record["bank_angle_cmd"][:-shift]
    found = command_following_metrics(flight._replace(record=record))
    assert found["bank_deg"]["delay_s"] == pytest.approx(0.24)


def test_papers_aircraft_answers_at_once(flown):
    for axis in command_following_metrics(flown("paper")).values():
        assert axis["rms"] == 0.0


def test_identified_lag_is_found_on_jsbsim(flown):
    """Load factor about 0.2 s late, bank about 0.4 s, as the identified second-order lags say."""
    found = command_following_metrics(flown("paper", "model=jsbsim"))
    assert found["load_factor"]["delay_s"] == pytest.approx(0.2, abs=0.05)
    assert found["bank_deg"]["delay_s"] == pytest.approx(0.4, abs=0.1)


def test_point_mass_has_no_residual_and_jsbsim_a_small_one(flown):
    """The point mass is its own model, to rounding; on JSBSim the estimator's drag is better than the law's."""
    own = flight_residuals(flown("paper", "model=identified"))
    assert np.abs(own.drag_of_law).max() < 1e-6  # N
    flight = flown("paper", "model=jsbsim")
    found = residual_metrics(flight, flight_residuals(flight))
    law, estimator = found["drag_of_law_kn"]["rms"], found["drag_of_estimator_kn"]["rms"]
    assert estimator < 0.05 < law < 1.0  # kN, of a drag of about 36 kN
    assert found["thrust_kn"]["rms"] < 0.01  # kN: the engine deck is JSBSim's own


def test_residual_shows_a_wrong_drag(flown):
    flight = flown("paper", "model=jsbsim")
    record = flight.record.copy()
    record["drag"] -= 1000.0  # N
    found = flight_residuals(flight._replace(record=record)).drag_of_estimator
    assert np.nanmean(found) == pytest.approx(1000.0, abs=20.0)
