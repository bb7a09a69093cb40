"""`ftc-jsb inner-loop` and `identify` tell by their exit code whether what they made is good enough."""

import shutil

import pytest
from click.testing import CliRunner

from ftc_jsb.cli.main import main
from ftc_jsb.identify.judgement import LIMITS, shortcomings
from ftc_jsb.resources import aircraft_folder


def test_a_criterion_that_is_missed_is_exit_1_and_named(tmp_path):
    """The 737 judged as a fighter: its load factor takes 0.7 s to rise, 0.6 are asked for."""
    folder = tmp_path / "agile"
    shutil.copytree(aircraft_folder("737"), folder)
    path = folder / "aircraft.toml"
    path.write_text(path.read_text().replace('airplane_class = "III"', 'airplane_class = "IV"'))
    result = CliRunner().invoke(
        main, ["inner-loop", str(folder), "--report", "--out", str(tmp_path / "out")]
    )
    assert result.exit_code == 1
    assert "not good enough: 737 at 188 m/s: load factor rise 0.7" in result.output
    assert "s against 0.6 s" in result.output


def test_an_airspeed_that_does_not_trim_is_exit_1(tmp_path):
    """A T-37 at 300 m/s, thrice what its thrust pays for."""
    folder = tmp_path / "fast"
    shutil.copytree(aircraft_folder("T37"), folder)
    path = folder / "aircraft.toml"
    path.write_text(path.read_text() + "\n[inner_loop]\nstep_airspeeds = [300.0]\n")
    result = CliRunner().invoke(
        main, ["inner-loop", str(folder), "--report", "--out", str(tmp_path / "out")]
    )
    assert result.exit_code == 1
    assert "no trim at 300 m/s" in result.output


def test_design_speeds_outside_the_test_range_are_refused(tmp_path):
    """A folder begun from a fighter's, with its 190 to 290 m/s left in: nothing is kept at 0 conditions."""
    folder = tmp_path / "fast"
    shutil.copytree(aircraft_folder("T37"), folder)
    path = folder / "aircraft.toml"
    path.write_text(path.read_text() + "\n[inner_loop]\ndesign_airspeeds = [190.0, 290.0]\n")
    result = CliRunner().invoke(main, ["inner-loop", str(folder), "--out", str(tmp_path / "out")])
    assert result.exit_code == 2
    assert "no airspeed of inner_loop.design_airspeeds lies within flight_test" in result.output


@pytest.mark.parametrize("key", LIMITS)
def test_each_residual_can_fail_an_identification(key):
    good = {name: limit for name, (limit, _) in LIMITS.items()}
    good |= {"flights": 80, "flights_held_out": 8, "flights_not_flown": 8}
    assert shortcomings(good) == []
    (said,) = shortcomings(good | {key: 1.01 * good[key]})
    assert said.startswith(LIMITS[key][1])
    (said,) = shortcomings(good | {"flights_not_flown": 200})
    assert "200 of 288" in said
