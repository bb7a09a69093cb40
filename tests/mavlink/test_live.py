"""`ftc-jsb fly` as a live vehicle: reset, shutdown, lingering, read-only replay, and bad options."""

import socket
import subprocess
import time

import pytest
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.recording.netcdf import load
from tests.mavlink.ground import Ground
from tests.mavlink.ports import HOST
from tests.mavlink.programs import BIN, reported_port

REBOOT_SHUTDOWN = dialect.MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN


def started(folder, *arguments):
    return subprocess.Popen(
        [BIN / "ftc-jsb", *arguments], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )  # fmt: skip


def heard_by(port):
    """A ground station, once the vehicle hears it."""
    until = time.monotonic() + 180.0
    while time.monotonic() < until:
        ground = Ground(port)
        try:
            ground.wait_for("HEARTBEAT", within=0.5)
            return ground
        except (AssertionError, ConnectionError):
            ground.close()
            time.sleep(0.2)
    raise AssertionError("no vehicle")


def test_reset_in_flight_and_after_it_flies_anew_and_keeps_every_flight(tmp_path):
    """Reset in the first flight; the second is complete, lingers, is reset; the third is shut down."""
    process = started(
        tmp_path, "fly", "nominal", "--set", "duration=3", "--realtime", "--mavlink", f"udpin:{HOST}:0",
        "--linger", "60", "--out", "o",
    )  # fmt: skip
    ground = heard_by(reported_port(process))
    ground.wait_for("ATTITUDE", lambda m: m.time_boot_ms > 500, within=180.0)
    assert ground.ask(REBOOT_SHUTDOWN, 1) == 0
    ground.wait_for("ATTITUDE", lambda m: m.time_boot_ms < 500)
    standby = dialect.MAV_STATE_STANDBY
    ground.wait_for("HEARTBEAT", lambda m: m.system_status == standby, within=20.0)
    ground.beat()
    assert ground.ask(REBOOT_SHUTDOWN, 1) == 0
    ground.wait_for("HEARTBEAT", lambda m: m.system_status == dialect.MAV_STATE_ACTIVE)
    assert ground.ask(REBOOT_SHUTDOWN, 2) == 0
    _, errors = process.communicate(timeout=180)
    ground.close()
    assert process.returncode == 0, errors
    flights = [load(tmp_path / "o" / f"flight{n}.nc") for n in ("-1", "-2", "")]
    assert [flight.outcome.status for flight in flights] == ["ended", "complete", "ended"]
    assert flights[0].commands[-1].command.kind == "reset"
    assert flights[1].record.size == 301


def test_recording_is_shown_again_and_obeys_nobody(tmp_path):
    """`replay --mavlink` in real time: seen, not commanded, and still the same to the bit."""
    made = started(tmp_path, "fly", "nominal", "--set", "duration=4", "--out", "o")
    made.communicate(timeout=180)
    process = started(
        tmp_path, "replay", "o/flight.nc", "--realtime", "--mavlink", f"udpin:{HOST}:0"
    )
    ground = heard_by(reported_port(process))
    ground.wait_for("ATTITUDE", within=180.0)
    ground.command(dialect.MAV_CMD_DO_FLIGHTTERMINATION, 1)
    output, errors = process.communicate(timeout=180)
    ground.close()
    assert process.returncode == 0, errors
    assert "the same to the bit: 401 samples" in output


def refused(folder, *arguments):
    result = subprocess.run(
        [BIN / "ftc-jsb", "fly", "nominal", *arguments],
        cwd=folder, capture_output=True, text=True, timeout=180, check=False,
    )  # fmt: skip
    assert result.returncode == 2, result.stderr
    assert "Traceback" not in result.stderr
    return result.stderr


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["--mavlink", "udp:1"], "expected udpout:HOST:PORT"),
        (
            ["--mavlink", "udpin:no.such.host.invalid:14550"],
            "--mavlink udpin:no.such.host.invalid:14550",
        ),
        (["--mavlink", "udpout::14550", "--mavlink-key", "none"], "cannot be read"),
        (["--sysid", "0"], "--sysid"),
        (["--realtime", "0"], "--realtime"),
    ],
    ids=str,
)
def test_bad_option_is_one_sentence(arguments, says, tmp_path):
    assert says in refused(tmp_path, *arguments)
    assert not list(tmp_path.iterdir())


def test_port_that_is_taken_is_told_before_flying(tmp_path):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind((HOST, 0))
        port = other.getsockname()[1]
        assert "in use" in refused(tmp_path, "--mavlink", f"udpin:{HOST}:{port}")
