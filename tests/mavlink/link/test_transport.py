"""Who is sent to, and that nobody holds the vehicle up, on real sockets."""

import socket

import numpy as np
import pytest

from ftc_jsb.recording.columns import ROW
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from tests.mavlink.ground import Ground, aloft
from tests.mavlink.ports import HOST


@pytest.mark.parametrize("kind", ["udpout", "udpin", "tcpin"])
def test_peer_that_is_dead_deaf_or_absent_changes_nothing(kind, flown):
    """Nobody at the port; or a TCP client that connects and never reads. The data are the same."""
    scenario = ["duration=3", "model=jsbsim"]
    plain = fly(load_scenario("paper", scenario)).record
    with aloft(*scenario, scenario="paper", kind=kind, factor=3.0) as up:
        if kind == "tcpin":
            deaf = socket.create_connection((HOST, up.port))
            deaf.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        up.thread.join(30.0)
        flight = up.flight
        if kind == "tcpin":
            deaf.close()
    for name in ROW.names:
        np.testing.assert_array_equal(flight.record[name], plain[name], err_msg=name)


def test_silent_udp_peer_is_no_longer_sent_to(monkeypatch):
    monkeypatch.setattr("ftc_jsb.mavlink.link.transport.PEER_TIMEOUT", 0.5)
    with aloft() as up:
        ground = Ground(up.port)
        ground.wait_for("ATTITUDE")
        ground.silent = True
        ground.listen(1.0)
        assert ground.listen(0.3) == []
        ground.beat()
        ground.wait_for("ATTITUDE")
        ground.close()
