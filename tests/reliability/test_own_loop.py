"""Whatever a loop of the user's raises, sets or changes costs its own flight only."""

import os
import signal
import sys
from pathlib import Path

import numpy as np
import pytest

from ftc_jsb.errors import LoopError
from ftc_jsb.loops.fence import fenced
from ftc_jsb.runs.single import fly_and_save
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from tests.cli.command import run
from tests.runs.test_comparison import stopped_at

LOOPS = "tests.reliability.loops"
NO_SUCH = "tests.reliability.loops:Nowhere"


def scenario(loop):
    return load_scenario("paper", ["duration=2", f"loop.name='{LOOPS}:{loop}'", "fault=[]"])


@pytest.mark.parametrize(
    ("loop", "says"),
    [
        ("Exits", "SystemExit: 0"),
        ("Overflows", "expected a finite number"),
        ("RaisesBase", "GeneratorExit"),
        ("Unprintable", "StrangeError"),
        ("ManyDigits", "step returned a int, expected a Command"),
        ("Deep", "RecursionError"),
    ],
)
def test_flight_ends_as_failed_and_is_kept(loop, says):
    flight = fly(scenario(loop))
    assert flight.outcome.status == "failed"
    assert says in flight.outcome.reason
    assert flight.record.size == 50  # up to where the loop failed


def test_what_a_loop_sets_is_set_back(tmp_path, monkeypatch):
    import netCDF4  # noqa: F401, which sets a variable of the environment of its own when it is first imported

    monkeypatch.chdir(tmp_path)
    before = (dict(os.environ), sys.path[:], np.geterr(), signal.getsignal(signal.SIGTERM))
    streams = (sys.stdout, sys.stderr)
    (tmp_path / "o").mkdir()
    fly_and_save(scenario("SetsEverything"), Path("o"), stopped_at(None))
    assert Path.cwd() == tmp_path
    assert (dict(os.environ), sys.path, np.geterr(), signal.getsignal(signal.SIGTERM)) == before
    assert (sys.stdout, sys.stderr) == streams
    assert os.stat(tmp_path / "o" / "flight.nc").st_mode & 0o400
    assert (tmp_path / "o" / "metrics.json").is_file()


def test_constructor_and_import_that_exit_are_refused(tmp_path, monkeypatch):
    (tmp_path / "exits.py").write_text("import sys; sys.exit(0)\n")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(LoopError, match="SystemExit"):
        fly(load_scenario("paper", ["loop.name='exits:Loop'"]))


def test_fence_survives_a_folder_that_is_gone(tmp_path, monkeypatch):
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    with fenced():
        gone.rmdir()


def test_other_flights_of_a_comparison_are_flown_and_reported(tmp_path):
    """A loop that exits, one that changes everything, and one that flies after them."""
    loops = f"compare.loops=['{LOOPS}:Exits', '{LOOPS}:SetsEverything', '{LOOPS}:Enormous', 'ftc']"
    result = run(
        "compare", "paper", "--set", loops, "--set", "compare.models=['paper']", "--allow-code",
        "--set", "duration=2", "--out", str(tmp_path / "o"), cwd=Path.cwd(),
    )  # fmt: skip
    assert result.returncode == 0, result.stderr
    assert len(list((tmp_path / "o").glob("*.nc"))) == 4
    assert (tmp_path / "o" / "report.html").is_file()
    assert "Warning" not in result.stderr
