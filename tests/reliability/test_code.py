"""A data file never runs code unasked: scenarios and recordings name loops, the user has them imported."""

import shutil
import tomllib
from pathlib import Path

import pytest
import tomli_w

from ftc_jsb.resources import shipped
from tests.cli.command import assert_refused, run

LOOP = "stranger:Loop"
TEMPLATE = Path(__file__).parents[1] / "control" / "my_loop.py"


@pytest.fixture
def folder(tmp_path):
    """A scenario, and beside it the module that it names, which tells when it is run."""
    paper = tomllib.loads((shipped("scenarios") / "paper.toml").read_text())
    paper |= {"loop": {"name": LOOP}, "compare": {"loops": [LOOP]}}
    (tmp_path / "s.toml").write_text(tomli_w.dumps(paper))
    module = f"open('has-run', 'w').close()\n{TEMPLATE.read_text()}\nLoop = MyLoop\n"
    (tmp_path / "stranger.py").write_text(module)
    return tmp_path


def test_no_command_imports_what_a_file_names(folder):
    for command in ("fly", "compare", "margins"):
        assert_refused(run(command, "s.toml", cwd=folder), LOOP, "stranger.py", "--allow-code")
    checked = run("check", "s.toml", cwd=folder)
    assert checked.returncode == 0, checked.stderr
    assert f"loop {LOOP}: not looked into; would import {folder / 'stranger.py'}" in checked.stdout
    for command in ("check", "fly"):
        shutil.copy(TEMPLATE, folder / "other.py")
        assert_refused(run(command, "s.toml", "--set", "loop.name='stranger'", cwd=folder))
    assert not (folder / "has-run").exists()


def test_recording_imports_nothing_unasked(folder):
    flown = run(
        "fly",
        "s.toml",
        "--allow-code",
        "--set",
        "duration=1",
        "--set",
        "fault=[]",
        "--out",
        "o",
        cwd=folder,
    )
    assert flown.returncode in (0, 1), flown.stderr
    (folder / "has-run").unlink()
    assert_refused(run("replay", "o/flight.nc", cwd=folder), LOOP, "--allow-code")
    for arguments in (("report", "o/flight.nc"), ("convert", "o/flight.nc", "--to", "csv")):
        assert run(*arguments, cwd=folder).returncode == 0
    assert not (folder / "has-run").exists()
    assert run("replay", "o/flight.nc", "--allow-code", cwd=folder).returncode == 0
    assert (folder / "has-run").exists()


def test_loop_that_the_user_names_is_flown(folder):
    for typed in (["--loop", LOOP], ["--set", f"loop.name='{LOOP}'"], ["--allow-code"]):
        flown = run("fly", "s.toml", *typed, "--set", "duration=1", "--set", "fault=[]", cwd=folder)
        assert flown.returncode in (0, 1), flown.stderr
