"""What FlightGear is sent: real UDP packets of JSBSim's FGNetFDM, against the recording."""

import socket
import struct
import subprocess
import sys
import time

import numpy as np
import pytest

from ftc_jsb.errors import ScenarioError
from ftc_jsb.flightgear.viewer import output_directive, viewer
from ftc_jsb.recording.columns import ROW
from ftc_jsb.recording.netcdf import load
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from ftc_jsb.simulation.pacing import Pacer
from tests.cli.command import assert_refused, run

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


def test_fly_sends_position_and_attitude_in_real_time(listener, tmp_path):
    """`fly --flightgear` for 3 s in a turn: each packet's attitude is one of the recording's, in order,
    to 1e-6 rad, its altitude to 1e-3 m, north and east to 5 m (0.5 % of the way: a sphere). The
    whole takes its 3 s.
    """
    port = listener.getsockname()[1]
    started = time.monotonic()
    process = subprocess.Popen(
        [sys.executable, "-m", "ftc_jsb", "fly", "paper", "--model", "jsbsim", "--flightgear",
         f"127.0.0.1:{port}", "--out", "o", "--set", "duration=3",
         "--set", "reference.heading_deg=[[0,0],[3,15]]"],
        cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    packets = []
    while process.poll() is None:
        try:
            packets.append(listener.recv(2048))
        except TimeoutError:
            assert time.monotonic() - started < 100.0
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 0, errors
    assert time.monotonic() - started > 3.0
    record = load(tmp_path / "o" / "flight.nc").record
    assert all(len(packet) == SIZE for packet in packets)
    assert {HEAD.unpack_from(packet)[0] for packet in packets} == {24}
    values = np.array([HEAD.unpack_from(packet) for packet in packets])
    assert 130 <= len(values) <= 210  # 3 s at 50 to 67 Hz
    longitude, latitude, altitude, phi, theta, psi = values[:, [2, 3, 4, 6, 7, 8]].T
    rows = []
    for k in range(
        len(values)
    ):  # JSBSim runs at twice the loop's rate: half the packets lie between rows
        away = (
            np.abs(record["roll"] - phi[k])
            + np.abs(record["pitch"] - theta[k])
            + np.abs(np.angle(np.exp(1j * (record["yaw"] - psi[k]))))
            + np.abs(record["altitude"] - altitude[k]) / 100.0
        )
        if away.min() < 1e-6:
            rows.append((k, int(np.argmin(away))))
    assert len(rows) >= 0.45 * len(values)  # every third frame is sent, every second is a row
    index, row = np.array(rows).T
    turning = record["time"][row] > 0.3  # before, one row is like another
    assert (np.diff(row[turning]) > 0).all()
    np.testing.assert_allclose(phi[index], record["roll"][row], atol=1e-6)
    np.testing.assert_allclose(theta[index], record["pitch"][row], atol=1e-6)
    np.testing.assert_allclose(altitude[index], record["altitude"][row], atol=1e-3)
    north = (latitude[index] - np.radians(47.0)) * 6_367_000.0  # [m] of the meridian at 47 deg
    assert np.abs(north - record["north"][row]).max() < 5.0
    east = (longitude[index] - np.radians(8.0)) * 6_389_700.0 * np.cos(np.radians(47.0))
    assert np.abs(east - record["east"][row]).max() < 5.0


def test_flight_is_the_same_with_and_without_a_viewer(listener, flown):
    """Bit for bit, flat out, with somebody listening and with nobody."""
    scenario = load_scenario("paper", ["model=jsbsim", "duration=8"])
    alone = fly(scenario).record
    for port in (listener.getsockname()[1], 9):
        with output_directive(viewer(f"127.0.0.1:{port}", scenario)) as output:
            shown = fly(scenario, output=output).record
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
        viewer(endpoint, load_scenario("paper", ["model=jsbsim"]))


def test_point_masses_are_not_shown(tmp_path):
    for model in ("paper", "identified"):
        refused = run(
            "fly", "paper", "--model", model, "--flightgear", "localhost:5550", cwd=tmp_path
        )
        assert_refused(refused, f"the model '{model}' is a point mass", "--model jsbsim")
    assert not list(tmp_path.iterdir())
