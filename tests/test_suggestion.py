"""What is meant by a name that is not known: its own section first, other words than ours, capitals."""

import pytest

from ftc_jsb.errors import UserError
from ftc_jsb.resources import aircraft_folder
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.suggestion import SYNONYMS
from ftc_jsb.typed_file import key_paths


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("sead=3", "seed"),
        ("fault[0].begin=3", "start"),
        ("fault[0].onset=3", "start"),
        ("fault[0].effectivness=0.5", "effectiveness"),
        ("initial.speed=250", "airspeed"),
        ("initial.Altitude=3000", "altitude"),
        ("loop.gain=[1,1,1]", "gains"),
        ("wind.turbulance='light'", "turbulence"),
        ("effectiveness=0.5", "effectiveness"),  # of another section
    ],
)
def test_a_key_that_is_not_known(written, meant):
    with pytest.raises(UserError, match=f"did you mean {meant!r}"):
        load_scenario("paper", [written])


def test_nothing_is_suggested_for_what_is_like_nothing():
    with pytest.raises(UserError) as refused:
        load_scenario("paper", ["qqqq=1"])
    assert "did you mean" not in str(refused.value)


@pytest.mark.parametrize("name", ["papper", "Paper", "papre"])
def test_a_scenario_that_is_not_known(name):
    with pytest.raises(UserError, match="did you mean 'paper'"):
        load_scenario(name)


def test_an_aircraft_in_capitals():
    with pytest.raises(UserError, match="did you mean 'f16'"):
        aircraft_folder("F-16")


def test_other_words_lead_to_keys_that_there_are():
    from ftc_jsb.campaign.schema import Campaign

    known = {
        key.replace("[0]", "").rpartition(".")[2]
        for m in (Scenario, Campaign)
        for key in key_paths(m)
    }
    sections = {"aircraft", "fault", "gust", "loop"}
    assert set(SYNONYMS.values()) <= known | sections


def test_every_problem_of_a_file_is_listed():
    with pytest.raises(UserError) as refused:
        load_scenario("paper", ["duration=-1", "sead=2", "fault[0].kind='gone'"])
    assert "3 problems\n" in str(refused.value)
    for key in ("duration", "sead", "fault[0].kind"):
        assert key in str(refused.value)


@pytest.mark.parametrize(
    ("text", "said"), [("600 kt", "308.667 m/s"), ("10000 ft", "3048 m"), ("6 bananas", "")]
)
def test_a_number_with_a_unit_is_refused_by_name(text, said):
    with pytest.raises(UserError, match="expected a number without a unit") as refused:
        load_scenario("paper", [f"initial.airspeed={text}"])
    assert said in str(refused.value)
