"""Theil's coefficient and its parts on series whose numbers are known, and the answer drawn from them."""

import numpy as np
import pytest

from ftc_jsb.analysis.validity import compare_flights, difference, judge
from ftc_jsb.scenario.schema import Agreement

TIME = np.linspace(0.0, 2.0 * np.pi, 10_001)[:-1]


def test_a_shifted_series_differs_by_bias_alone():
    found = difference(np.sin(TIME) + 0.5, np.sin(TIME))
    assert found.rms == pytest.approx(0.5)
    assert found.peak == pytest.approx(0.5)
    assert (found.bias, found.variance, found.covariance) == pytest.approx(
        (1.0, 0.0, 0.0), abs=1e-9
    )
    # RMS of sin + 1/2 is sqrt(3/4), of sin sqrt(1/2)
    assert found.theil == pytest.approx(0.5 / (np.sqrt(0.75) + np.sqrt(0.5)))


def test_a_stretched_series_differs_by_variance_and_a_delayed_one_by_covariance():
    stretched = difference(1.5 * np.sin(TIME), np.sin(TIME))
    assert (stretched.bias, stretched.variance) == pytest.approx((0.0, 1.0), abs=1e-9)
    delayed = difference(np.sin(TIME - 0.1), np.sin(TIME))
    assert (delayed.bias, delayed.variance, delayed.covariance) == pytest.approx(
        (0.0, 0.0, 1.0), abs=1e-9
    )


def test_the_coefficient_is_0_for_the_same_and_1_for_the_opposite():
    assert difference(TIME, TIME).theil == 0.0
    assert difference(np.sin(TIME), -np.sin(TIME)).theil == pytest.approx(1.0)
    assert difference(TIME[:0], TIME[:0]) is None


def test_the_identified_point_mass_is_nearer_to_jsbsim_than_the_papers(flown):
    """Thrust command: the paper's aircraft is another one, the identified one is this one."""
    jsbsim = flown("paper", "model=jsbsim")
    found = [compare_flights(flown("paper", f"model={m}"), jsbsim) for m in ("paper", "identified")]
    paper, identified = (entry["thrust_command_kn"]["theil"] for entry in found)
    assert identified < 0.1 * paper
    for entry in found:
        for name, parts in entry.items():
            if name != "position_m":
                total = parts["bias"] + parts["variance"] + parts["covariance"]
                assert total == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("same", "airspeed", "heading", "answer", "decides"),
    [
        (True, 0.2, 0.1, "yes", "airspeed"),  # 0.67 times the 0.3 m/s agreed
        (True, 0.2, 0.3, "in part", "heading"),  # 1.5 times the 0.2 deg
        (True, 1.5, 0.3, "no", "airspeed"),  # 5 times
        (False, 0.2, 0.1, "no", "airspeed"),
    ],
)
def test_the_answer_needs_the_verdict_and_what_is_agreed_to_be_small(
    flown, same, airspeed, heading, answer, decides
):
    flight = flown("paper")
    variables = compare_flights(flight, flight)
    variables["airspeed_mps"]["rms"] = airspeed
    variables["heading_deg"]["rms"] = heading
    found = judge([{"same_verdict": same, "variables": variables}], Agreement())
    assert found["answer"] == answer
    assert found["decides"]["title"] == decides
