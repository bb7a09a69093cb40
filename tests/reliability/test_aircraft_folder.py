"""An aircraft's folder from elsewhere: it writes nowhere but in the cache, and cannot abort the program."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.errors import AircraftError
from ftc_jsb.resources import shipped
from ftc_jsb.six_dof.weaving.trial import try_out
from ftc_jsb.six_dof.weaving.woven_aircraft import woven_aircraft

EDIT = """
[[correction]]
name = "x"
reason = "x"
[[correction.edit]]
file = "{file}"
element = "{element}"
expect = "{expect}"
replace = "{replace}"
"""


@pytest.fixture
def mine(tmp_path):
    """The shipped F-16 as a user's own folder."""
    return Path(shutil.copytree(shipped("aircraft") / "f16", tmp_path / "mine"))


def edited(folder, file="", element="flight_control", expect="", replace=""):
    with (folder / "aircraft.toml").open("a") as file_:
        file_.write(EDIT.format(file=file, element=element, expect=expect, replace=replace))
    return load_aircraft(str(folder))


def test_edit_of_a_file_elsewhere_is_refused_and_changes_nothing(mine, tmp_path):
    other = tmp_path / "other.xml"
    other.write_text("<system><a>1</a></system>")
    for file in (
        str(other.with_suffix("")),
        "../" * 12 + str(other.with_suffix(""))[1:],
        "..",
        "\\u0000",
    ):
        folder = Path(shutil.copytree(mine, tmp_path / "copy", dirs_exist_ok=True))
        aircraft = edited(folder, file=file, element="a", expect="1", replace="2")
        with pytest.raises(
            AircraftError, match=r"file: .*expected a name of a file in|no engine or system"
        ):
            woven_aircraft(aircraft, True)
    assert other.read_text() == "<system><a>1</a></system>"


def test_model_elsewhere_is_refused(mine, tmp_path):
    model = tmp_path / "model" / "model.xml"
    model.parent.mkdir()
    model.write_text("<fdm_config/>")
    text = (mine / "aircraft.toml").read_text()
    for name in (str(model.parent), "../" * 12 + str(model.parent)[1:], "..", "."):
        changed = text.replace('jsbsim_model = "f16"', f'jsbsim_model = "{name}"')
        assert changed != text
        (mine / "aircraft.toml").write_text(changed)
        with pytest.raises(AircraftError, match=r"jsbsim_model: .*expected a name of a file in"):
            woven_aircraft(load_aircraft(str(mine)), True)


@pytest.mark.parametrize(
    ("file", "element", "expect", "said"),
    [
        ("", "propulsion[", "", "expected the path of an element"),
        ("F100-PW-229", "milthrust", "17800.0", "cannot be woven: .*could not convert"),
    ],
)
def test_edit_that_breaks_the_aircraft_is_a_sentence(mine, file, element, expect, said):
    aircraft = edited(mine, file=file, element=element, expect=expect, replace="x")
    with pytest.raises(AircraftError, match=f"aircraft 'f16'.*{said}"):
        woven_aircraft(aircraft, True)


@pytest.mark.parametrize(
    "contents",
    [
        "",
        "<system",
        '<system name="ftc numbers"/>',
        '<system name="ftc numbers"><channel/></system>',
        '<system name="ftc numbers"><channel name="a"><fcs_function name="b"><function><value>x</value>'
        "</function></fcs_function></channel></system>",
        '<system name="ftc numbers"><property value="x">a b</property><channel name="a"><gain/></channel>'
        "</system>",
        '<system name="ftc numbers" file="ftc_numbers"/>',
        '<nothing name="ftc numbers"/>',
    ],
)
def test_inner_loop_of_any_contents_ends_in_a_sentence(mine, tmp_path, contents):
    """The interpreter is still there: JSBSim aborts, if it does, in a process of its own."""
    (mine / "inner_loop.xml").write_text(contents)
    command = [sys.executable, "-m", "ftc_jsb", "fly", "paper", "--model", "jsbsim"]
    command += [
        "--set",
        f"aircraft.name={mine}",
        "--set",
        "duration=1",
        "--out",
        str(tmp_path / "out"),
    ]
    made = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert made.returncode == 2, made.stderr
    assert "Traceback" not in made.stderr
    assert "internal error" not in made.stderr


def test_aircraft_that_aborts_jsbsim_is_a_sentence(tmp_path, monkeypatch):
    program = tmp_path / "aborts.py"
    monkeypatch.setattr("ftc_jsb.six_dof.weaving.trial.PROGRAM", program)
    for body, said in (
        ("import os; os.abort()", "ends with an abort"),
        ("import os; os.kill(os.getpid(), 11)", "ends with a bad address"),
        ("raise SystemExit(3)", "ends with exit code 3"),
    ):
        program.write_text(body)
        with pytest.raises(AircraftError, match=f"aircraft 'x': JSBSim {said}"):
            try_out("x", "f16", tmp_path / "never-tried")
    monkeypatch.setattr("ftc_jsb.six_dof.weaving.trial.PATIENCE", 1.0)
    program.write_text("import time; time.sleep(30)")
    with pytest.raises(AircraftError, match="does not come to an end"):
        try_out("x", "f16", tmp_path / "never-tried")


def test_users_own_folder_flies(mine):
    assert woven_aircraft(load_aircraft(str(mine)), True).is_dir()
