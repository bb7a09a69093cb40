"""MAVProxy on a pseudo-terminal, for a minute, as a user has it."""

import re

import pytest

from tests.mavlink.clients.mavproxy import MavProxy
from tests.mavlink.ports import reserved_port
from tests.mavlink.programs import vehicle

NAGS = ("no home", "Failed", "UNSUPPORTED", "timeout", "unknown", "Traceback", "link 1 down\nlink")


@pytest.fixture
def port():
    with reserved_port() as number:
        yield number


def test_a_minute_with_mavproxy(port, tmp_path):
    """Mode, parameters within 5 s of the first heartbeat (11 without the FTP NAK), a failure injected,
    a home, and nothing that is asked or refused over and over in 60 s.
    """
    proxy = MavProxy(port, tmp_path)
    try:
        proxy.wait_for("Waiting for heartbeat", 30.0)
        with vehicle(port, tmp_path, "--set", "duration=300", "--linger", "60"):
            proxy.wait_for("Detected vehicle 1:1", 30.0)
            parameters = proxy.wait_for(r"Received \d+ parameters", 30.0)
            proxy.wait_for("ARMED", 180.0)  # in flight; kernels may have to be compiled first
            for line in ("param set SYS_FAILURE_EN 1", "param set FAIL_EFF 0.5"):
                proxy.type(line)
                proxy.read(2.0)
            proxy.type("long INJECT_FAILURE 101 5 1 0 0 0 0")
            proxy.read(4.0)
            proxy.type("status HOME_POSITION")
            proxy.read(50.0)
    finally:
        proxy.close()
    shown = proxy.output
    assert "Mode GUIDED" in shown
    assert "ARMED" in shown
    assert parameters < 5.0
    assert int(re.search(r"Received (\d+) parameters", shown)[1]) > 15
    assert "INJECT_FAILURE: ACCEPTED" in shown
    for text in ("fault injected: thrust 0.50", "fault detected", "fault isolated: thrust 0.5"):
        assert text in shown
    assert "latitude : 470000000" in shown
    for nag in NAGS:
        assert nag not in shown, shown
    lines = [line for line in shown.splitlines() if "height" not in line and len(line) > 8]
    assert not {line for line in lines if lines.count(line) > 2}
