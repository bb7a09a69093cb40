"""Every command refuses bad usage in one sentence, by exit code 2."""

import pytest

from tests.cli.command import assert_refused, run


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["fly", "papre"], "no scenario 'papre'"),
        (["fly", "none.toml"], "none.toml: no such file"),
        (["fly", "paper", "--set", "initial.airspeed=-5"], "initial.airspeed"),
        (["fly", "paper", "--set", "wings=2"], "unknown key 'wings'"),
        (["fly", "paper", "--loop", "ftv"], "no loop 'ftv'"),
        (["fly", "paper", "--model", "glider"], "'glider' is not one of"),
        (["fly", "paper", "--model", "jsbsim", "--set", "aircraft.name=f99"], "no aircraft 'f99'"),
        (["compare", "paper", "--set", "compare.loops=['ftv']"], "no loop 'ftv'"),
        (["report", "none.nc"], "none.nc: no such file"),
        (["figures", "none.nc"], "none.nc: no such file"),
        (["convert", "none.nc", "--to", "csv"], "none.nc: no such file"),
        (["identify", "f99"], "no aircraft 'f99'"),
        (["inner-loop", "f99"], "no aircraft 'f99'"),
        (["inner-loop", "c172x"], "a piston engine; only turbine engines can be woven"),
        (["inner-loop", "weather-balloon"], "no engine in weather-balloon.xml"),
        (["inner-loop", "X15"], "a rocket engine"),
        (
            ["identify", "c172x"],
            "`ftc-jsb inner-loop` makes one of an aircraft of the jsbsim package",
        ),
        (["margins", "f16", "--model", "paper"], "--model paper: does not fly 'f16'"),
        (["margins", "f15", "--model", "paper"], "--model paper: does not fly 'f15'"),
        (["check", "paper", "--set", "loop.rate=0"], "loop.rate"),
        (["fly"], "Missing argument 'SCENARIO'"),
        (["soar"], "No such command 'soar'"),
    ],
    ids=" ".join,
)
def test_bad_usage_is_one_sentence(arguments, says, tmp_path):
    assert_refused(run(*arguments, cwd=tmp_path), says)
    assert not list(tmp_path.iterdir())  # not even an empty folder
