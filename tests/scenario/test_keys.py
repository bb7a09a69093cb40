"""Dotted keys: where they lead, and what is said where they lead nowhere."""

import pytest

from ftc_jsb.errors import ScenarioError
from ftc_jsb.scenario.keys import path_of, value_at, with_value
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.scenario.loop import Loop

VALUES = {"duration": 10.0, "fault": [{"start": 20.0}], "loop": {"gains": (1.0, 2.0, 3.0)}}


@pytest.mark.parametrize("key", ["fault[0].start", "fault.0.start", " fault[0].start "])
def test_two_ways_to_write_an_index(key):
    assert path_of(key) == ("fault", "0", "start")
    assert value_at(VALUES, key) == 20.0


@pytest.mark.parametrize(
    "key",
    ["wings", "fault[1].start", "fault[-1].start", "fault[²].start", "duration.long", "", "."],
)
def test_nothing_is_none(key):
    assert value_at(VALUES, key) is None


def test_value_is_set_in_a_copy():
    changed = with_value(VALUES, "fault[0].start", 3.0)
    changed = with_value(changed, "loop.gains[1]", 5.0)
    changed = with_value(changed, "wind.speed", 7.0)
    assert changed == {
        "duration": 10.0, "fault": [{"start": 3.0}], "loop": {"gains": [1.0, 5.0, 3.0]},
        "wind": {"speed": 7.0},
    }  # fmt: skip
    assert VALUES == {
        "duration": 10.0, "fault": [{"start": 20.0}], "loop": {"gains": (1.0, 2.0, 3.0)},
    }  # fmt: skip


@pytest.mark.parametrize(
    ("key", "says"),
    [
        ("fault[7].start", "fault has 1 entries; '7' is none of 0 to 0"),
        ("fault[-1].start", "fault has 1 entries; '-1' is none of 0 to 0"),
        ("fault[²].start", "fault has 1 entries; '²' is none of 0 to 0"),
        ("fault[" + 5000 * "9" + "]", "fault has 1 entries; "),
        ("duration.long", "duration is a value, not a section"),
        ("fault[0].start.time", "fault.0.start is a value, not a section"),
    ],
)
def test_key_that_leads_nowhere_is_refused(key, says):
    with pytest.raises(ScenarioError) as refusal:
        with_value(VALUES, key, 1.0)
    assert str(refusal.value).startswith(says)


def test_override_by_a_digit_that_is_no_number_is_one_sentence():
    with pytest.raises(ScenarioError) as refusal:
        load_scenario("paper", ["fault[²].start=3"])
    assert str(refusal.value) == "--set fault[²].start: fault has 1 entries; '²' is none of 0 to 0"


def test_number_of_a_loop_by_its_key():
    assert value_at(Loop().model_dump(), "gains[0]") == Loop().gains[0]
    assert value_at(Loop().model_dump(), "detector.margin") == Loop().detector.margin
