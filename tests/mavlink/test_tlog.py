"""Telemetry logs that the tools of MAVLink read: of a live flight, and of a recording."""

import re
import subprocess
import sys

import pytest

from ftc_jsb.convert import convert
from ftc_jsb.errors import RecordingError
from ftc_jsb.recording.netcdf import load
from tests.mavlink.ports import reserved_port
from tests.mavlink.programs import BIN, dumped

SECONDS = re.compile(r"^(\d{4})-\d\d-\d\d \d\d:(\d\d):(\d\d\.\d+): ")


def test_recording_becomes_a_log_that_mavlogdump_reads(flown, tmp_path):
    """60 s of the F-16's flight at the default rates, with its fault told at 20 s."""
    path = tmp_path / "flight.tlog"
    convert(flown("paper", "model=jsbsim"), "tlog", path)
    assert len(dumped(path, "ATTITUDE")) == pytest.approx(60 * 25, abs=2)
    assert len(dumped(path, "HEARTBEAT")) == pytest.approx(60, abs=1)
    texts = dumped(path, "STATUSTEXT")
    told = next(line for line in texts if "fault injected: thrust 0.60" in line)
    year, _, seconds = SECONDS.match(told).groups()
    assert year == "1970"
    assert float(seconds) == pytest.approx(20.0, abs=0.1)
    assert any("fault isolated" in line for line in texts)
    named = dumped(path, "NAMED_VALUE_FLOAT")
    last = [line for line in named if "EFF_THR," in line][-1]
    assert float(re.search(r"value : ([\d.]+)", last)[1]) == pytest.approx(0.6, abs=0.02)


def test_live_log_and_both_commands(tmp_path):
    """`fly --tlog` beside an endpoint that nobody hears, then `convert`; a file is not written over."""

    def run(*arguments):
        return subprocess.run(
            [BIN / "ftc-jsb", *arguments], cwd=tmp_path, capture_output=True, text=True, timeout=180
        )  # fmt: skip

    with reserved_port() as port:
        flown = run(
            "fly", "paper", "--set", "duration=3", "--realtime", "--mavlink", f"udpout:127.0.0.1:{port}",
            "--tlog", "live.tlog", "--out", "o",
        )  # fmt: skip
    assert flown.returncode == 0, flown.stderr
    assert "link: " in flown.stderr
    assert "real time: " in flown.stderr
    attitudes = dumped(tmp_path / "live.tlog", "ATTITUDE")
    assert len(attitudes) >= 30  # 25 Hz for 3 s and more, on a machine that may be busy
    assert dumped(tmp_path / "live.tlog", "STATUSTEXT")[-1].endswith(
        "flight complete, id : 0, chunk_seq : 0}"
    )
    assert run("convert", "o/flight.nc", "--to", "tlog").returncode == 0
    assert len(dumped(tmp_path / "o" / "flight.tlog", "VFR_HUD")) == pytest.approx(30, abs=2)
    again = run("convert", "o/flight.nc", "--to", "tlog")
    assert again.returncode == 2
    assert "--force" in again.stderr
    assert run("convert", "o/flight.nc", "--to", "tlog", "--force").returncode == 0
    unknown = run("convert", "o/flight.nc", "--to", "vhs")
    assert unknown.returncode == 2
    assert "tlog" in unknown.stderr
    assert "the same to the bit" in run("replay", "o/flight.nc").stdout


def test_log_of_a_flight_flat_out_is_that_of_its_recording(tmp_path):
    command = [
        BIN / "ftc-jsb",
        "fly",
        "paper",
        "--set",
        "duration=5",
        "--tlog",
        "f.tlog",
        "--out",
        "o",
    ]
    subprocess.run(command, cwd=tmp_path, capture_output=True, timeout=180, check=True)
    convert(load(tmp_path / "o" / "flight.nc"), "tlog", tmp_path / "g.tlog")
    assert (tmp_path / "f.tlog").read_bytes() == (tmp_path / "g.tlog").read_bytes()


def test_log_that_cannot_be_written_is_one_sentence(flown, tmp_path):
    with pytest.raises(RecordingError, match="cannot be written"):
        convert(flown("paper"), "tlog", tmp_path / "none" / "flight.tlog")
    result = subprocess.run(
        [BIN / "ftc-jsb", "fly", "paper", "--tlog", "none/live.tlog"],
        cwd=tmp_path, capture_output=True, text=True, timeout=180, check=False,
    )  # fmt: skip
    assert result.returncode == 2
    assert "none/live.tlog: cannot be written" in result.stderr
    assert not list(tmp_path.iterdir())


def test_explorer_opens_the_log(flown, tmp_path):
    """MAVExplorer reads logs by this class of the library: every message of it, to the end."""
    path = tmp_path / "flight.tlog"
    convert(flown("paper"), "tlog", path)
    code = (
        "import sys\n"
        "from pymavlink import mavutil\n"
        "log = mavutil.mavlink_connection(sys.argv[1])\n"
        "count = 0\n"
        "while (message := log.recv_msg()) is not None:\n"
        "    assert message.get_type() != 'BAD_DATA'\n"
        "    count += 1\n"
        "print(count, log.flightmode)\n"
    )
    result = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", code, path],
        capture_output=True, text=True, timeout=180, check=True,
    )  # fmt: skip
    assert int(result.stdout.split()[0]) > 5000
