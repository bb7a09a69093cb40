"""Two runs into one folder, signals in flight, disks that fail: what was flown is kept, and success is true."""

import errno
import json
import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest

from ftc_jsb.atomic_file import PART
from ftc_jsb.errors import RecordingError, WriteError
from ftc_jsb.interruption import interruptible, uninterrupted
from ftc_jsb.recording import netcdf
from ftc_jsb.recording.netcdf import load
from ftc_jsb.runs.output_folder import LOCK, output_folder
from ftc_jsb.runs.rescue import save_or_rescue
from tests.cli.command import assert_refused, run

SHORT = ("fly", "paper", "--set", "duration=1", "--set", "fault=[]")


def start(*arguments, cwd, **environment):
    return subprocess.Popen(
        [sys.executable, "-m", "ftc_jsb", *arguments], cwd=cwd, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, env={**os.environ, **environment},
    )  # fmt: skip


def test_of_two_runs_into_one_folder_one_is_whole_and_one_is_refused(tmp_path):
    """Every time, however they meet; `--force` does not let one into the other's folder either."""
    for number in range(3):
        out = tmp_path / f"o{number}"
        both = [start(*SHORT, "--out", str(out), *force, cwd=tmp_path) for force in ((), ())]
        ends = [(process.communicate(timeout=120)[1], process.returncode) for process in both]
        codes = sorted(code for _, code in ends)
        assert codes == [0, 2], ends
        refused = next(text for text, code in ends if code == 2)
        assert "another process is writing there" in refused or "is not empty" in refused
        assert {path.name for path in out.iterdir()} == {"flight.nc", "metrics.json"}
        load(out / "flight.nc")


def test_folder_in_use_is_refused_also_with_force(tmp_path):
    with (
        output_folder(tmp_path, "a", True),
        pytest.raises(RecordingError, match="another process"),
    ):
        output_folder(tmp_path, "b", True).__enter__()


def test_folder_of_a_killed_process_is_free_again(tmp_path):
    (tmp_path / LOCK).touch()
    (tmp_path / f"flight.nc.0123{PART}").write_bytes(b"half")
    with output_folder(tmp_path, "a", False):
        assert [path.name for path in tmp_path.iterdir()] == [LOCK]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_signal_saves_what_was_flown(tmp_path, number):
    flying = tmp_path / "flying"
    process = start(
        "fly", "paper", "--set", "duration=3000", "--loop", "tests.reliability.loops:Waits",
        "--out", str(tmp_path / "o"), cwd=Path.cwd(), FTC_JSB_TEST_FLYING=str(flying),
    )  # fmt: skip
    deadline = time.monotonic() + 90.0
    while not flying.exists() and time.monotonic() < deadline:
        time.sleep(0.02)
    for _ in range(3):  # the impatient
        process.send_signal(number)
        time.sleep(0.01)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 130, errors
    assert "Traceback" not in errors
    assert load(tmp_path / "o" / "flight.nc").outcome.status == "interrupted"
    assert (tmp_path / "o" / "metrics.json").is_file()


def test_signals_wait_but_where_they_are_let_through():
    done = []

    def fly_and_save():
        with uninterrupted():
            signal.raise_signal(signal.SIGINT)
            done.append("held")
            with suppress(KeyboardInterrupt), interruptible():
                done.append("never")
            signal.raise_signal(signal.SIGINT)
            done.append("saved")

    with pytest.raises(KeyboardInterrupt):
        fly_and_save()
    assert done == ["held", "saved"]


def full(*_arguments, **_named):
    raise RuntimeError("NetCDF: HDF error")


def test_flight_that_cannot_be_saved_is_saved_elsewhere(flown, tmp_path, monkeypatch):
    """What netCDF4 says of a full disk, as the file of the folder is written."""
    write = netcdf._write

    def refuse(flight, path):
        return full() if path.parent == tmp_path / "o" else write(flight, path)

    (tmp_path / "o").mkdir()
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setattr(netcdf, "_write", refuse)
    with pytest.raises(WriteError, match=r"the disk may be full; the flight is saved as (.*)") as e:
        save_or_rescue(flown("paper"), tmp_path / "o" / "flight.nc")
    assert not list((tmp_path / "o").iterdir())
    place = Path(str(e.value).rpartition(" ")[2])
    assert load(place).record.size == flown("paper").record.size


def test_full_disk_is_no_success(tmp_path):
    """/dev/full, as the disk that a log is written to; and a limit on the size of files."""
    refused = run(*SHORT, "--tlog", "/dev/full", "--out", "o", cwd=tmp_path)
    assert_refused(refused, "/dev/full")
    assert run(*SHORT, "--out", "p", cwd=tmp_path).returncode == 0
    limit = [
        "bash",
        "-c",
        'ulimit -f 4; trap "" XFSZ; exec "$@"',
        "-",
        sys.executable,
        "-m",
        "ftc_jsb",
    ]
    for arguments in (
        ["convert", "p/flight.nc", "--to", "tlog"],
        [*SHORT, "--tlog", "q.tlog", "--out", "q"],
        ["convert", "p/flight.nc", "--to", "csv"],
    ):
        result = subprocess.run(
            [*limit, *arguments], cwd=tmp_path, capture_output=True, text=True, check=False,
            timeout=120,
        )  # fmt: skip
        assert_refused(result, "cannot be written")
        assert os.strerror(errno.EFBIG) in result.stderr or "the disk may be full" in result.stderr
    assert not list(tmp_path.glob("p/flight.*l*"))


def test_estimates_that_overflow_are_null_with_a_reason(tmp_path):
    result = run(
        "fly", "paper", "--set", "duration=2", "--set", "fault=[]", "--json", "--out",
        str(tmp_path / "o"), "--loop", "tests.reliability.loops:Enormous", cwd=Path.cwd(),
    )  # fmt: skip
    assert result.returncode in (0, 1), result.stderr
    assert "Warning" not in result.stderr
    (entry,) = json.loads(result.stdout, parse_constant=pytest.fail)["flights"].values()
    assert "beyond the largest number" in str(entry["not_finite"])


def test_internal_error_ends_with_3_and_a_crash_file(tmp_path, monkeypatch, capsys):
    import ftc_jsb.scenario.load
    from ftc_jsb.cli import main

    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setattr(ftc_jsb.scenario.load, "load_scenario", lambda *_: 1 / 0)
    monkeypatch.setattr(sys, "argv", ["ftc-jsb", "check", "paper"])
    with pytest.raises(SystemExit) as end:
        main()
    assert end.value.code == 3
    (crash,) = tmp_path.glob("ftc-jsb-crash-*.txt")
    assert "ZeroDivisionError" in crash.read_text()
    assert str(crash) in capsys.readouterr().err
