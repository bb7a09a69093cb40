"""`ftc` beside `no-ftc` on one map: two flights that send to the same ground station."""

import socket
import time

from pymavlink.dialects.v20 import common as dialect

from tests.mavlink.ports import HOST
from tests.mavlink.programs import vehicle


def test_one_station_hears_two_vehicles(tmp_path):
    """System 1 with FTC and system 2 without, each with its own estimate and place."""
    folders = [tmp_path / name for name in ("ftc", "no-ftc")]
    for folder in folders:
        folder.mkdir()
    heard: dict[int, set[str]] = {1: set(), 2: set()}
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as ground:
        ground.bind((HOST, 0))
        ground.settimeout(0.5)
        port = ground.getsockname()[1]
        wanted = {"HEARTBEAT", "GLOBAL_POSITION_INT", "NAMED_VALUE_FLOAT"}
        with (
            vehicle(port, folders[0], "--sysid", "1"),
            vehicle(port, folders[1], "--sysid", "2", "--loop", "no-ftc"),
        ):
            until = time.monotonic() + 180.0
            while time.monotonic() < until and not all(wanted <= kinds for kinds in heard.values()):
                try:
                    data = ground.recv(2048)
                except TimeoutError:
                    continue
                message = dialect.MAVLink(None).parse_buffer(data)[0]
                heard[message.get_srcSystem()].add(message.get_type())
    assert all(wanted <= kinds for kinds in heard.values())
