"""`ftc-jsb fly` as a user meets it: files, exit codes, messages, interruption."""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

from ftc_jsb.recording.netcdf import load
from tests.cli.command import assert_refused, run


def test_fly_writes_recording_and_metrics_from_any_folder(tmp_path):
    result = run("fly", "paper", "--set", "duration=5", "--out", "here", cwd=tmp_path)
    assert result.returncode == 0, result.stderr
    assert sorted(p.name for p in (tmp_path / "here").iterdir()) == ["flight.nc", "metrics.json"]
    stored = json.loads((tmp_path / "here" / "metrics.json").read_text())
    assert list(stored["flights"]) == ["paper-ftc"]
    assert "Airspeed, RMSE" in result.stdout


def test_json_output_is_json_alone(tmp_path):
    result = run("fly", "paper", "--set", "duration=2", "--loop", "ekf", "--json", cwd=tmp_path)
    assert json.loads(result.stdout)["flights"]["paper-ekf"]["status"] == "complete"


def test_broken_limit_is_exit_code_1_and_told(tmp_path):
    result = run(
        "fly", "paper", "--loop", "no-ftc", "--set", "limits.error_airspeed=[-1,1]", cwd=tmp_path
    )
    assert result.returncode == 1
    assert "limit broken: error_airspeed first at 20." in result.stderr


def test_output_folder_is_checked_before_flying(tmp_path):
    full = tmp_path / "full"
    full.mkdir()
    (full / "thesis.txt").write_text("mine")
    assert_refused(run("fly", "paper", "--out", "full", cwd=tmp_path), "is not empty", "--force")
    assert [p.name for p in full.iterdir()] == ["thesis.txt"]
    result = run("fly", "paper", "--set", "duration=1", "--out", "full", "--force", cwd=tmp_path)
    assert result.returncode == 0
    assert (full / "thesis.txt").read_text() == "mine"
    assert_refused(run("fly", "paper", "--out", "full/thesis.txt", cwd=tmp_path), "is a file")
    assert_refused(run("fly", "paper", "--out", "/proc/none", cwd=tmp_path), "cannot be written")


def test_own_loop_and_own_scenario_are_found_from_the_working_folder(tmp_path):
    """A module and a .toml beside the user, both by name, with the installed command."""
    source = Path(__file__).parents[1] / "control" / "my_loop.py"
    (tmp_path / "mine.py").write_text(source.read_text())
    shipped = Path(__file__).parents[2] / "scenarios" / "nominal.toml"
    (tmp_path / "own.toml").write_text(shipped.read_text().replace('"nominal"', '"own"'))
    command = Path(sys.executable).parent / "ftc-jsb"
    result = subprocess.run(
        [command, "fly", "own.toml", "--loop", "mine:MyLoop", "--out", "o"],
        cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False,
    )  # fmt: skip
    assert result.returncode in (0, 1), result.stderr
    assert load(tmp_path / "o" / "flight.nc").scenario.loop.name == "mine:MyLoop"
    broken = run("fly", "own.toml", "--loop", "mine:BrokenLoop", cwd=tmp_path)
    assert_refused(broken, "mine:BrokenLoop, step at 0.51 s: ZeroDivisionError")


def test_ctrl_c_saves_what_was_flown_and_exits_130(tmp_path):
    """SIGINT into a long flight; the recording is readable and says that it was interrupted.

    The loop leaves a file behind at 10 s of flight, so that the signal comes in flight.
    """
    template = (Path(__file__).parents[1] / "control" / "my_loop.py").read_text()
    (tmp_path / "mine.py").write_text(
        template
        + "\n\nclass Tells(MyLoop):\n"
        + "    def step(self, time, measurement, reference):\n"
        + "        if time == 10.0:\n            open('flying', 'w').close()\n"
        + "        return super().step(time, measurement, reference)\n"
    )
    process = subprocess.Popen(
        [sys.executable, "-m", "ftc_jsb", "fly", "nominal", "--loop", "mine:Tells", "--out", "o",
         "--set", "duration=30000"],
        cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # a job in the background ignores it
    )  # fmt: skip
    deadline = time.monotonic() + 90.0
    while not (tmp_path / "flying").exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 130, errors
    assert "Traceback" not in errors
    flight = load(tmp_path / "o" / "flight.nc")
    assert flight.outcome.status == "interrupted"
    assert 1000 < flight.record.size < 3_000_000
