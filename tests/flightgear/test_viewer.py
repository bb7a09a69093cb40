"""What FlightGear is sent: real UDP packets of FGNetFDM, against the recording."""

import socket
import struct
import time

import numpy as np
import pytest

from ftc_jsb.errors import ScenarioError
from ftc_jsb.flightgear.viewer import Sender, viewer
from ftc_jsb.recording.columns import ROW
from ftc_jsb.recording.netcdf import load, save
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from ftc_jsb.simulation.pacing import Pacer
from tests.cli.command import run

# FGNetFDM version 24, network byte order: version and padding; longitude, latitude [rad], altitude [m];
# agl, phi, theta, psi, alpha, beta [rad] as floats.
HEAD = struct.Struct("!II3d6f")
SIZE = 408  # [bytes]


@pytest.fixture
def listener():
    """A UDP socket on a free port, with room for a whole flight."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
        sock.bind(("127.0.0.1", 0))
        sock.settimeout(0.2)
        yield sock


def received(sock: socket.socket) -> list[bytes]:
    packets = []
    while True:
        try:
            packets.append(sock.recv(2048))
        except TimeoutError:
            return packets


@pytest.mark.parametrize("model", ["jsbsim", "identified"])
def test_fly_sends_position_and_attitude_in_real_time(listener, tmp_path, model):
    """`fly --flightgear` for 3 s in a turn: each packet's attitude is one of the recording's, in order,
    to 1e-6 rad (single precision), its altitude to 1e-3 m, north and east to 5 m (0.5 % of the way: a
    sphere). The whole takes its 3 s.
    """
    port = listener.getsockname()[1]
    started = time.monotonic()
    result = run(
        "fly", "paper", "--model", model, "--flightgear", f"127.0.0.1:{port}", "--out", "o",
        "--set", "duration=3", "--set", "reference.heading_deg=[[0,0],[3,15]]", cwd=tmp_path,
    )  # fmt: skip
    assert result.returncode == 0, result.stderr
    assert f"in,60,,{port},udp --aircraft=ufo --lat=47 --lon=8 --timeofday=noon" in result.stderr
    assert time.monotonic() - started > 3.0
    assert_shows(received(listener), load(tmp_path / "o" / "flight.nc").record)


def assert_shows(packets, record):
    assert all(len(packet) == SIZE for packet in packets)
    values = np.array([HEAD.unpack_from(packet) for packet in packets])
    assert set(values[:, 0]) == {24}
    assert 140 <= len(values) <= 182  # 3 s at 50 to 60 Hz
    longitude, latitude, altitude, phi, theta, psi = values[:, [2, 3, 4, 6, 7, 8]].T
    away = np.abs(record["roll"] - phi[:, None]) + np.abs(record["pitch"] - theta[:, None])
    row = (away + np.abs(record["altitude"] - altitude[:, None])).argmin(axis=1)
    np.testing.assert_allclose(phi, record["roll"][row], atol=1e-6)
    np.testing.assert_allclose(theta, record["pitch"][row], atol=1e-6)
    np.testing.assert_allclose(psi, record["yaw"][row] % (2.0 * np.pi), atol=1e-6)
    np.testing.assert_allclose(altitude, record["altitude"][row], atol=1e-3)
    north = (latitude - np.radians(47.0)) * 6_367_000.0  # [m] of the meridian at 47 deg
    assert np.abs(north - record["north"][row]).max() < 5.0
    east = (longitude - np.radians(8.0)) * 6_389_700.0 * np.cos(np.radians(47.0))
    assert np.abs(east - record["east"][row]).max() < 5.0


def test_a_recording_is_shown(listener, tmp_path):
    """`replay --flightgear` at 4 times real time: packets of the recording, and nothing is flown."""
    scenario = load_scenario("paper", ["duration=3", "reference.heading_deg=[[0,0],[3,15]]"])
    save(fly(scenario), tmp_path / "flight.nc")
    endpoint = f"127.0.0.1:{listener.getsockname()[1]}"
    result = run("replay", "flight.nc", "--flightgear", endpoint, "--realtime", "4", cwd=tmp_path)
    assert (result.returncode, result.stdout) == (0, "flight.nc: shown\n"), result.stderr
    assert_shows(received(listener), load(tmp_path / "flight.nc").record)


def test_flight_is_the_same_with_and_without_a_viewer(listener, flown):
    """Bit for bit, flat out, with somebody listening and with nobody."""
    scenario = load_scenario("paper", ["model=jsbsim", "duration=8"])
    alone = fly(scenario).record
    for port in (listener.getsockname()[1], 9):
        sender = Sender(viewer(f"127.0.0.1:{port}"), scenario.initial)
        shown = fly(scenario, [sender]).record
        sender.close()
        for name in ROW.names:
            np.testing.assert_array_equal(shown[name], alone[name], err_msg=name)
    assert len(received(listener)) > 100


def test_pacing_changes_nothing_and_keeps_absolute_time():
    """1 s of flight in 1 s; at four times, in 0.25 s at least; the same flight."""
    scenario = load_scenario("paper", ["duration=1"])
    alone = fly(scenario).record
    for factor in (1.0, 4.0):
        started = time.monotonic()
        paced = fly(scenario, observers=[Pacer(scenario.loop.rate, factor)]).record
        assert time.monotonic() - started >= 1.0 / factor
        for name in ROW.names:
            np.testing.assert_array_equal(paced[name], alone[name], err_msg=name)


@pytest.mark.parametrize(
    "endpoint", ["localhost", ":5550", "localhost:0", "localhost:x", "h:70000"]
)
def test_endpoint_that_is_none_is_refused(endpoint):
    with pytest.raises(ScenarioError, match="expected HOST:PORT"):
        viewer(endpoint)
