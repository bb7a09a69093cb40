"""Scenario files: what is shipped is valid, what is wrong is refused with file, key and expectation."""

import math
import tomllib
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ftc_jsb.aircraft.point_mass_file import load_point_mass
from ftc_jsb.errors import ScenarioError
from ftc_jsb.resources import aircraft_folder, shipped
from ftc_jsb.scenario.load import load_scenario, parse_scenario, scenario_names, scenario_toml
from ftc_jsb.scenario.schema import Scenario

PAPER = (shipped("scenarios") / "paper.toml").read_text(encoding="utf-8")


def test_scenarios_that_are_shipped():
    assert scenario_names() == [
        "737",
        "a4",
        "engine-out",
        "f15",
        "f4n",
        "helix",
        "intermittent",
        "nominal",
        "paper",
        "ramp",
        "severe",
        "speed-first",
        "t37",
        "t38",
        "total-loss",
        "turbulence",
    ]


@pytest.mark.parametrize("name", scenario_names())
def test_shipped_scenario_is_valid_and_survives_being_written(name):
    """Written as TOML with its defaults and read back, a scenario is the same scenario."""
    scenario = load_scenario(name)
    assert scenario.name == name
    assert parse_scenario(scenario_toml(scenario), "written") == scenario


def test_aircraft_whose_name_is_a_number():
    """`--set aircraft.name=737`: what TOML reads as a number is a name."""
    assert load_scenario("nominal", ["aircraft.name=737"]).aircraft.name == "737"
    with pytest.raises(ScenarioError, match=r"aircraft\.name: input should be a valid string"):
        load_scenario("nominal", ["aircraft.name=true"])


def test_paper_scenario_is_section_5():
    """Section 5 of the paper, key by key, and the assumptions that README states where it is silent."""
    s = load_scenario("paper")
    assert (s.initial.airspeed, s.initial.altitude) == (300.0, 3048.0)
    assert (s.reference.filter_frequency, s.reference.filter_damping) == (3.0, 1.0)
    assert s.loop.gains == (1.0, 1.0, 1.0)
    assert s.loop.trim_filter == 50.0
    assert s.loop.estimator.process_noise == (1e-10, 1e-10, 1e-3, 1e-10)
    assert s.loop.estimator.measurement_noise == (1e-10, 1e-10, 1e-3)
    assert not s.loop.estimator.gate
    assert not s.loop.estimator.bounded
    assert (s.fault[0].effectiveness, s.fault[0].start) == (0.6, 20.0)
    assert s.loop.estimator.initial_covariance == (1e-6, 1e-8, 1e-6, 1e-4)
    assert s.loop.rate == 100.0
    aircraft = load_point_mass(aircraft_folder("paper"))
    assert (aircraft.mass.gravity, aircraft.load_factor.minimum) == (9.81, -3.0)


@pytest.mark.parametrize(
    ("override", "says"),
    [
        ("initial.airspeed=-5", "initial.airspeed: input should be greater than or equal to 50"),
        ("initial.airspeed=nan", "initial.airspeed"),
        ("initial.airspeed=inf", "initial.airspeed"),
        ("initial.airspeed=true", "initial.airspeed: input should be a valid number"),
        ("initial.airspeed=fast", "initial.airspeed: input should be a valid number"),
        ("loop.trim_filter=0", "loop.trim_filter: input should be greater than or equal to 0.5"),
        ("loop.rate=0", "loop.rate: input should be greater than or equal to 1"),
        ("duration=1e9", "duration: input should be less than or equal to 86400"),
        ("duration=0", "duration: input should be greater than 0"),
        ("duration=86400", "duration x loop.rate"),
        ("loop.gain=1", "unknown key 'loop.gain'"),
        ("wings=2", "unknown key 'wings'"),
        ("fault[0].effectiveness=1.5", "fault[0].effectiveness: input should be less"),
        ("fault[0].kind=explosion", "fault[0].kind: input should be 'loss-of-effectiveness'"),
        ("fault[0].shape=ramp", "a fault of shape 'ramp' needs the key 'rise'"),
        ("fault[0].rise=3", "a fault of shape 'step' does not take the key 'rise'"),
        ("fault[0].end=10", "end must be later than start"),
        ("reference.heading_deg=[[0,350]]", "heading is continuous and never wrapped"),
        ("wind.speed=-5", "wind.speed: "),
        ("wind.turbulence=heavy", "wind.turbulence: "),
        ("sensors.alpha.noise=0.1", "alpha.noise: expected noise_deg for this signal"),
        ("sensors.speed.noise=0.1", "unknown key 'sensors.speed'"),
        ("loop.gains=1", "loop.gains: expected a list"),
        ("loop=3", "loop: expected a section"),
        ("duraton=3", "unknown key 'duraton'; did you mean 'duration'?"),
        ("reference.heading_deg=[[0,0],[0,1]]", "times must increase"),
        ("reference.heading_deg=[]", "reference.heading_deg"),
        ("reference.airspeed=[[0,9000]]", "reference.airspeed: 9000.0 at 0.0 s is outside"),
        ("loop.estimator.process_noise=[1,1,1]", "process_noise: expected 4 numbers"),
        ("loop.estimator.channels=['thrust','thrust']", "a channel is named twice"),
        ("limits.airspeed=[400,100]", "limits.airspeed: low must be less than high"),
        ("limits.airspeed=[400]", "limits.airspeed"),
        ("compare.loops=[]", "compare.loops"),
        ("compare.models=['paper','paper']", "compare.models: an entry is given twice"),
        ("model=glider", "model: input should be 'paper', 'identified', 'jsbsim' or 'flightgear'"),
        ("sensors.profile=noisy", "sensors.profile: input should be 'perfect'"),
        ("name='a/b'", "name: string should match pattern"),
    ],
)
def test_wrong_value_is_refused_with_its_key(override, says):
    with pytest.raises(ScenarioError, match=r"paper\.toml") as refusal:
        load_scenario("paper", [override])
    assert says in str(refusal.value)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    ("override", "says"),
    [
        ("loop.gains", "expected KEY=VALUE"),
        ("=3", "expected KEY=VALUE"),
        ("fault.7.start=3", "fault has 1 entries"),
        ("duration.long=3", "duration is a value"),
    ],
)
def test_override_that_is_none_is_refused(override, says):
    with pytest.raises(ScenarioError) as refusal:
        load_scenario("paper", [override])
    assert says in str(refusal.value)


def test_override_reaches_every_level():
    overrides = [
        "duration=12",
        "loop.gains=[2, 1, 1]",
        "fault[0].start=3",
        "fault.0.effectiveness=0.5",
    ]
    scenario = load_scenario("paper", [*overrides, "loop.name=oracle"])
    assert scenario.duration == 12.0
    assert scenario.loop.gains == (2.0, 1.0, 1.0)
    assert (scenario.fault[0].start, scenario.fault[0].effectiveness) == (3.0, 0.5)
    assert scenario.loop.name == "oracle"


def test_file_that_is_not_there_not_toml_or_no_text(tmp_path: Path):
    with pytest.raises(ScenarioError, match="no such file"):
        load_scenario(str(tmp_path / "none.toml"))
    with pytest.raises(ScenarioError, match="shipped are 737, a4, engine-out, f15, f4n, helix"):
        load_scenario("papre")
    with pytest.raises(ScenarioError, match="is a folder"):
        load_scenario(str(tmp_path))
    bad = tmp_path / "bad.toml"
    bad.write_text("duration = = 3")
    with pytest.raises(ScenarioError, match=r"bad\.toml: not TOML"):
        load_scenario(str(bad))
    bad.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ScenarioError, match="cannot be read"):
        load_scenario(str(bad))
    bad.write_text("name = 'x'")
    with pytest.raises(ScenarioError, match="reference: missing"):
        load_scenario(str(bad))


_leaves = st.one_of(
    st.integers(),
    st.floats(),
    st.booleans(),
    st.text(max_size=5),
    st.lists(st.floats(), max_size=3),
)
_trees = st.recursive(
    _leaves, lambda inner: st.dictionaries(st.text(max_size=6), inner, max_size=3)
)


@given(key=st.sampled_from([*Scenario.model_fields, "other"]), value=_trees)
def test_no_value_of_any_key_escapes_validation(key, value):
    """Whatever stands at a top-level key, the file is a scenario or is refused in one sentence."""
    import tomli_w

    values = tomllib.loads(PAPER)
    values[key] = value
    try:
        text = tomli_w.dumps(values)
    except (TypeError, ValueError):  # not representable in TOML at all
        return
    try:
        scenario = parse_scenario(text, "file.toml")
    except ScenarioError as refusal:
        assert str(refusal).startswith("file.toml: ")
        return
    assert math.isfinite(scenario.duration)
    assert parse_scenario(scenario_toml(scenario), "again") == scenario
