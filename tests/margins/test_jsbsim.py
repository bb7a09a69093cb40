"""Margins of the loop on the JSBSim F-16, and the command that measures them."""

import json

import numpy as np
import pytest

from ftc_jsb.margins.condition import level_scenario
from ftc_jsb.margins.input_perturbation import Injection
from ftc_jsb.margins.measure import channel_margins
from ftc_jsb.margins.perturbed_flight import perturbed_flight
from ftc_jsb.simulation.fly import fly
from tests.cli.command import assert_refused, run


def test_both_ways_agree_on_the_f16():
    """Bank angle, 240 m/s: 0.5 dB, 5 %; at least 12 dB and 60 deg, coherent."""
    found = channel_margins(level_scenario("f16", "jsbsim"), "bank_angle", lambda line: None)
    assert found.agree
    assert found.classical.coherence > 0.98
    assert 4.0 < found.gain < 50.0
    assert 1.0 < found.classical.phase < 2.0
    assert np.isfinite(found.delay)


def test_injection_of_nothing_is_the_flight_itself():
    """With the fuel frozen the mass stays; commands of the first second are those of `fly`, to 1e-6."""
    scenario = level_scenario("f16", "jsbsim").model_copy(update={"duration": 5.0})
    altered = perturbed_flight(scenario, "thrust", Injection(np.zeros(501)), 5.0)
    record = fly(scenario).record
    np.testing.assert_array_equal(altered.commanded, altered.given)
    np.testing.assert_allclose(altered.commanded[:100], record["thrust_cmd"][:100], rtol=1e-3)


def test_interruption_is_not_taken_for_a_loop_that_breaks():
    def interrupt(commands, i):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        perturbed_flight(level_scenario("paper", "paper"), "thrust", interrupt, 1.0)


def test_condition_is_that_of_the_scenario_or_of_the_aircraft():
    assert level_scenario("paper", "jsbsim").initial.airspeed == 300.0
    assert level_scenario("f16", "jsbsim").initial.airspeed == 240.0
    given = level_scenario("helix", "jsbsim", airspeed=210.0, altitude=5000.0)
    assert (given.initial.airspeed, given.initial.altitude) == (210.0, 5000.0)
    assert given.loop.name == level_scenario("helix", "jsbsim").loop.name
    assert not given.fault


def test_command_writes_table_json_and_figure(tmp_path):
    """On the paper's point mass, which takes seconds."""
    done = run("margins", "paper", "--model", "paper", "--out", "m", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "Load factor" in done.stdout
    assert sorted(path.name for path in (tmp_path / "m").iterdir()) == ["bode.png", "margins.json"]
    stored = json.loads((tmp_path / "m" / "margins.json").read_text())
    assert set(stored["channels"]) == {"thrust", "load_factor", "bank_angle"}
    bank = stored["channels"]["bank_angle"]
    assert all(each["methods_agree"] for each in stored["channels"].values())
    assert bank["gain_margin_inserted_db"] == pytest.approx(46.0, abs=0.3)
    assert_refused(run("margins", "paper", "--out", "m", cwd=tmp_path), "--out m: is not empty")
    assert_refused(run("margins", "f99", cwd=tmp_path), "no aircraft 'f99'", "or a scenario")
    slow = run("margins", "f16", "--airspeed", "60", "--altitude", "15000", cwd=tmp_path)
    assert_refused(slow, "no trim at 60 m/s")
    assert_refused(run("margins", "f16", "--airspeed", "5", cwd=tmp_path), "airspeed")
    assert not (tmp_path / "out").exists()
