"""Intervals hold as often as they say, and stop rules end where their numbers say."""

import math

import numpy as np
import pandas as pd
import pytest

from ftc_jsb.campaign.schema import Stop
from ftc_jsb.campaign.sensitivity import first_order
from ftc_jsb.campaign.statistics import (
    area_under_roc,
    mean_difference,
    paired_probability,
    rate,
    wilson,
)
from ftc_jsb.campaign.stopping import Looks, events_of


def test_wilson_as_published():
    """Newcombe (1998), table I: 81 of 263 and 15 of 148."""
    assert wilson(81, 263)[1:] == pytest.approx((0.2553, 0.3662), abs=5e-5)
    assert wilson(15, 148)[1:] == pytest.approx((0.0624, 0.1605), abs=5e-5)
    assert wilson(0, 20)[1:] == pytest.approx((0.0, 0.1611), abs=5e-5)


def test_wilson_holds_about_as_often_as_it_says():
    """At p = 0.1 and 0.5 of 50 cases: 93 to 97 % of 4000 draws."""
    random = np.random.default_rng(1)
    for p in (0.1, 0.5):
        intervals = [wilson(int(k), 50) for k in random.binomial(50, p, 4000)]
        inside = np.mean([i.low <= p <= i.high for i in intervals])
        assert 0.93 <= inside <= 0.98


def test_pairs_and_means():
    found = paired_probability(30, 10, 100)
    assert found.value == pytest.approx(0.2)
    assert 0.0 < found.low < 0.2 < found.high < 0.35
    assert paired_probability(0, 0, 50).low < 0.0 < paired_probability(0, 0, 50).high
    mean = mean_difference(np.array([1.0, 2.0, 3.0, np.nan]))
    assert mean.value == pytest.approx(2.0)
    assert mean.high - mean.value == pytest.approx(4.302653 / math.sqrt(3.0), rel=1e-5)


def test_no_event_in_three_hours_proves_less_than_one_an_hour():
    """The rule of three: -ln 0.05 = 2.9957 hours."""
    assert rate(0, 2.9957).high == pytest.approx(1.0, rel=1e-4)
    assert rate(0, 2.9957).low == 0.0
    assert rate(10, 1.0).low == pytest.approx(5.4254, rel=1e-4)  # chi-squared, 20 degrees


def test_area_under_roc_of_two_normals():
    """Phi(1 / sqrt 2) for means one standard deviation apart, within its own interval."""
    random = np.random.default_rng(3)
    found = area_under_roc(random.normal(0, 1, 4000), random.normal(1, 1, 4000))
    assert found.low < 0.7602 < found.high
    assert found.high - found.low < 0.03


def test_indices_of_a_known_function():
    """Of 3 a + b with a, b uniform: 0.9 and 0.1 of the variance; c does not matter, and a text may."""
    random = np.random.default_rng(5)
    a, b, c = random.random((3, 4000))
    kind = random.choice(["x", "y"], 4000)
    table = pd.DataFrame({"a": a, "b": b, "c": c, "kind": kind})
    found = {index.parameter: index for index in first_order(table, 3 * a + b)}
    assert found["a"].value == pytest.approx(0.9, abs=0.02)
    assert found["b"].value == pytest.approx(0.1, abs=0.02)
    assert found["c"].value < 0.01
    by_kind = first_order(table, (kind == "x") + 0.01 * a)
    assert by_kind[0].parameter == "kind"
    assert by_kind[0].value > 0.99


def flight(case, verdict="inside limits", **values):
    row = {"case": case, "model": "paper", "loop": "ftc", "verdict": verdict, "end_time_s": 36.0}
    return row | {"false_alarms": 0, "fault_s": 0.0, "detection_delay_s": None} | values


def test_proven_rate_ends_at_the_same_case_whatever_the_order():
    """36 s a flight: 300 flights are 3 hours without an event, which prove less than 1 an hour."""
    rule = Stop(event="false-alarm", rate_per_hour=1.0, every=10)
    for order in (range(400), reversed(range(400))):
        looks = Looks(rule)
        for case in order:
            looks.add([flight(case)])
        assert looks.end == 300
    noisy = Looks(rule)
    noisy.add(flight(case, false_alarms=1) for case in range(400))
    assert noisy.end == 10  # refuted: ten events in 0.1 h


def test_interval_ends_when_it_is_narrow():
    looks = Looks(Stop(interval_width=0.1, every=50))
    looks.add(
        flight(case, "limits broken" if case % 2 else "inside limits") for case in range(1000)
    )
    assert looks.end is not None
    width = [wilson(n // 2, n) for n in (looks.end - 50, looks.end)]
    assert width[0].high - width[0].low > 0.1 >= width[1].high - width[1].low


def test_events_of_a_flight():
    assert events_of("failure", flight(0, "departed")) == 1
    assert events_of("loss-of-control", flight(0, "limits broken")) == 0
    assert events_of("false-alarm", flight(0, false_alarms=3)) == 3
    assert events_of("miss", flight(0)) is None
    assert events_of("miss", flight(0, fault_s=5.0)) == 1
    assert events_of("miss", flight(0, fault_s=5.0, detection_delay_s=0.3)) == 0
    assert events_of("failure", flight(0, verdict=None)) is None
