"""What one station may do to the others: nothing that they would notice."""

import socket
import time

import pytest
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.errors import LinkError
from ftc_jsb.mavlink.link.budget import Budget
from ftc_jsb.mavlink.link.endpoint import Endpoint
from ftc_jsb.mavlink.link.vehicle_link import Link
from ftc_jsb.mavlink.telemetry.message_streams import BUDGET, STREAMS, StreamSchedule
from ftc_jsb.mavlink.vehicle import Vehicle
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.command_source import CommandQueue
from tests.mavlink.ground import Ground, aloft
from tests.mavlink.ports import HOST

ATTITUDE = dialect.MAVLink_attitude_message.id
RESET = dialect.MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN
INTERVAL = dialect.MAV_CMD_SET_MESSAGE_INTERVAL
ONE, OTHER = (255, 190), (254, 190)


def test_station_does_not_slow_anothers_streams():
    now = [0.0]
    schedule = StreamSchedule(lambda: now[0])
    schedule.hear(ONE)
    schedule.hear(OTHER)
    assert schedule.set_rate(ATTITUDE, 1.0, ONE)
    assert schedule.rate(ATTITUDE) == 25.0  # the other has not asked for less
    assert schedule.set_rate(ATTITUDE, 50.0, OTHER)
    assert schedule.set_rate(ATTITUDE, 0.0, ONE)
    assert schedule.rate(ATTITUDE) == 50.0
    now[0] = 20.0
    schedule.hear(ONE)
    now[0] = 40.0  # the other has been silent for 40 s
    schedule.due()
    assert schedule.rate(ATTITUDE) == 0.0


def test_stations_together_ask_for_no_more_than_the_budget():
    schedule = StreamSchedule(lambda: 0.0)
    for station in (ONE, OTHER):
        for stream in STREAMS:
            schedule.set_rate(stream.id, 200.0, station)
    asked = sum(schedule.rate(stream.id) * stream.several for stream in STREAMS)
    assert 0.5 * BUDGET < asked <= BUDGET


def test_answers_have_a_budget():
    now = [0.0]
    budget = Budget(10.0, lambda: now[0])
    assert [budget.take() for _ in range(12)] == [True] * 10 + [False] * 2
    now[0] = 0.35
    assert [budget.take() for _ in range(4)] == [True] * 3 + [False]


def test_flood_of_resets_begins_one_flight():
    """Without a limit each of them saved a flight: 194 files in 12 s."""
    with aloft() as up:
        ground = Ground(up.port)
        assert ground.ask(RESET, 1) == dialect.MAV_RESULT_ACCEPTED
        for _ in range(20):
            assert ground.ask(RESET, 1) == dialect.MAV_RESULT_TEMPORARILY_REJECTED
        assert any(
            "one reset in 2 s" in m.text for m in ground.heard if m.get_type() == "STATUSTEXT"
        )


@pytest.mark.parametrize("key", [None, b"k" * 32])
def test_idle_tcp_clients_do_not_shut_stations_out(key):
    """Eight clients that say nothing, or nothing that is signed, give way; who is understood stays."""
    with aloft(kind="tcpin", key=key) as up:
        honest = Ground(up.port, stream=True, key=key)
        honest.wait_for("HEARTBEAT")
        idle = [socket.create_connection((HOST, up.port)) for _ in range(7)]
        time.sleep(2.2)
        more = [socket.create_connection((HOST, up.port)) for _ in range(3)]
        late = Ground(up.port, stream=True, key=key, system=254)
        late.wait_for("HEARTBEAT")
        assert honest.ask(INTERVAL, ATTITUDE, 1e5) == dialect.MAV_RESULT_ACCEPTED
        for connection in (*idle, *more):
            connection.close()


def test_endpoint_that_is_taken_leaves_nothing_open():
    """Warnings of unclosed resources are errors in these tests."""
    taken = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    taken.bind((HOST, 0))
    endpoint = Endpoint("udpin", HOST, taken.getsockname()[1])
    selectors = count_of_selectors()
    with pytest.raises(LinkError):
        Vehicle(load_scenario("paper"), CommandQueue(), Link(endpoint))
    assert count_of_selectors() == selectors
    taken.close()


def count_of_selectors() -> int:
    """Descriptors of this process that are epoll's."""
    import os

    found = 0
    for descriptor in os.listdir("/proc/self/fd"):
        try:
            found += "eventpoll" in os.readlink(f"/proc/self/fd/{descriptor}")
        except OSError:
            continue
    return found
