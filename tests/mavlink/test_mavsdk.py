"""A program on the real MAVSDK finds the vehicle, sees it, injects a failure and sees the estimate follow."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from ftc_jsb.recording.netcdf import load
from ftc_jsb.simulation.replay import differences, replay
from tests.mavlink.ports import reserved_port
from tests.mavlink.programs import vehicle

CLIENT = Path(__file__).parent / "clients" / "mavsdk_client.py"


@pytest.fixture
def port():
    with reserved_port() as number:
        yield number


def test_a_program_on_mavsdk_sees_commands_and_injects(port, tmp_path):
    """A session on the F-16 at 300 m/s and 3048 m over 47 N 8 E; the flight that it was replays to the bit."""
    with vehicle(port, tmp_path, "--model", "jsbsim", "--linger", "30") as process:
        client = subprocess.run(
            [sys.executable, CLIENT, str(port)], capture_output=True, text=True, timeout=300, check=False
        )  # fmt: skip
        assert client.returncode == 0, client.stderr[-3000:]
        assert process.wait(20.0) == 0, (tmp_path / "fly.log").read_text()
    seen = json.loads(client.stdout.splitlines()[-1])
    flight = load(tmp_path / "flight" / "flight.nc")
    vehicle_is_healthy_and_seen(seen)
    parameters_are_answered(seen)
    estimate_follows_the_failure(seen)
    flight_obeys_and_ends(seen)
    kinds = [command.kind for _, command in flight.commands]
    assert kinds == ["set-loop", "set-faults", "set-faults", "set-airspeed", "end"]
    assert differences(flight, replay(flight)) == []


def test_discovery_takes_less_than_three_seconds_of_a_vehicle_that_is_there(port, tmp_path):
    """The vehicle first, the client second; a heartbeat comes every second."""
    code = (
        "import asyncio, sys, time\n"
        "from mavsdk.asyncio import ComponentType, Configuration, Mavsdk\n"
        "async def main():\n"
        "    kind = ComponentType.GROUND_STATION\n"
        "    mavsdk = Mavsdk(Configuration.create_with_component_type(kind))\n"
        "    await mavsdk.add_any_connection(f'udpin://127.0.0.1:{sys.argv[1]}')\n"
        "    print(await mavsdk.first_autopilot(3.0) is not None)\n"
        "asyncio.run(main())\n"
    )
    with vehicle(port, tmp_path, "--tlog", "up.tlog"):
        for _ in range(300):  # the log is begun when the vehicle is
            if (tmp_path / "up.tlog").exists():
                break
            subprocess.run(["sleep", "0.1"], check=True)
        found = subprocess.run(
            [sys.executable, "-c", code, str(port)],
            capture_output=True, text=True, timeout=60, check=True,
        )  # fmt: skip
    assert found.stdout.splitlines()[-1] == "True"


def vehicle_is_healthy_and_seen(seen):
    assert seen["discovered"]
    assert seen["in_air"]
    assert seen["health_all_ok"]
    assert seen["armed"]
    latitude, longitude, altitude, relative = seen["position"]
    assert 47.0 <= latitude < 47.06
    assert longitude == pytest.approx(8.0, abs=1e-3)
    assert altitude == relative == pytest.approx(3048.0, abs=5.0)
    assert seen["truth"][2] == pytest.approx(3048.0, abs=5.0)
    assert abs(seen["attitude"][0]) < 5.0
    assert seen["hud"][0] == pytest.approx(300.0, abs=1.0)


def parameters_are_answered(seen):
    assert seen["gain"] == 1.0
    assert seen["gain_read"] == 1.5
    assert "DOES_NOT_EXIST" in seen["unknown"]
    assert "VALUE_OUT_OF_RANGE" in seen["too_large"]
    assert seen["listed"]["GAIN_SPD"] == 1.5
    assert len(seen["listed"]) > 15
    assert seen["unknown_s"] < 1.0  # a client that waits for an answer gives up after 1.5 s or more


def estimate_follows_the_failure(seen):
    """Denied while SYS_FAILURE_EN is 0; then 0.7 is estimated within 0.03 after 3 s, and 1 after OK."""
    assert "DENIED" in seen["inject_locked"]
    assert seen["inject"] == seen["inject_again"] == seen["heal"]
    assert "Error" not in str(seen["inject"])
    assert "UNSUPPORTED" in seen["inject_none"]
    assert seen["estimate"] == pytest.approx(0.7, abs=0.03)
    assert seen["estimate_healed"] == pytest.approx(1.0, abs=0.03)
    texts = " ".join(seen["texts"])
    for text in (
        "fault injected: thrust 0.70",
        "fault detected",
        "fault isolated: thrust 0.7",
        "recovered",
    ):
        assert text in texts
    assert {"EFF_THR", "EFF_THR_SD", "NZ_CMD", "NZ", "BANK_CMD", "THR_CMD"} <= {*seen["named"]}


def flight_obeys_and_ends(seen):
    """Speed set, disarming refused in the air, terminated, shut down."""
    assert "Error" not in str(seen["speed"])
    assert "DENIED" in seen["disarm"]
    assert seen["disarmed_at_the_end"]
