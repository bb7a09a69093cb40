"""Which messages are for the vehicle, and that each is answered, on real sockets."""

import time

from pymavlink.dialects.v20 import common as dialect

from tests.mavlink.ground import Ground, aloft

ACCEPTED = 0


def acks(ground):
    return [m.command for m in ground.heard if m.get_type() == "COMMAND_ACK"]


def test_every_command_is_acknowledged_once():
    """All of MAV_CMD that the library knows, with zeros: one COMMAND_ACK each, no more, no less."""
    numbers = [n for n in dialect.enums["MAV_CMD"] if n not in (185, 246)]  # end, reset
    with aloft() as up:
        ground = Ground(up.port)
        ground.wait_for("ATTITUDE")
        for start in range(0, len(numbers), 10):
            for number in numbers[start : start + 10]:
                ground.command(number)
            ground.listen(0.03)
        until = time.monotonic() + 20.0
        while time.monotonic() < until and len(acks(ground)) < len(numbers):
            ground.listen(0.1)
        ground.listen(0.5)
        ground.close()
    assert sorted(acks(ground)) == sorted(numbers)


def test_what_else_stations_ask_is_answered():
    with aloft() as up:
        ground = Ground(up.port)
        ground.wait_for("ATTITUDE")
        ground.send(dialect.MAVLink_mission_request_list_message(1, 1))
        assert ground.wait_for("MISSION_COUNT").count == 0
        payload = [1, 0, 5, 4, *([0] * 247)]
        ground.send(dialect.MAVLink_file_transfer_protocol_message(0, 1, 1, payload))
        nak = ground.wait_for("FILE_TRANSFER_PROTOCOL").payload
        assert (nak[0], nak[2], nak[3], nak[5], nak[12]) == (2, 5, 129, 4, 7)
        ground.send(dialect.MAVLink_timesync_message(0, 1234))
        reply = ground.wait_for("TIMESYNC")
        assert reply.ts1 == 1234
        assert reply.tc1 > 0
        ground.send(dialect.MAVLink_ping_message(5, 6, 0, 0))
        assert ground.wait_for("PING").seq == 6
        ground.command(dialect.MAV_CMD_GET_HOME_POSITION)
        home = ground.wait_for("HOME_POSITION")
        assert (home.latitude, home.longitude, home.altitude) == (470000000, 80000000, 0)
        ground.close()


def test_others_systems_commands_are_left_alone():
    with aloft(system=3) as up:
        ground = Ground(up.port)
        ground.wait_for("ATTITUDE")
        ground.command(dialect.MAV_CMD_DO_FLIGHTTERMINATION, 1, system=1)
        ground.command(dialect.MAV_CMD_DO_FLIGHTTERMINATION, 1, system=3, component=7)
        assert not [m for m in ground.listen(0.5) if m.get_type() == "COMMAND_ACK"]
        ground.command(dialect.MAV_CMD_DO_CHANGE_SPEED, 0, 290, system=3)
        ack = ground.wait_for("COMMAND_ACK")
        assert (ack.result, ack.target_system, ack.get_srcSystem()) == (ACCEPTED, 255, 3)
        flight = up.land()
        ground.close()
    assert len(flight.commands) == 2


def test_readonly_link_ignores_everything_and_still_sends():
    with aloft(readonly=True) as up:
        ground = Ground(up.port)
        ground.wait_for("ATTITUDE")
        ground.command(dialect.MAV_CMD_DO_FLIGHTTERMINATION, 1)
        ground.send(dialect.MAVLink_param_set_message(1, 1, b"TRIM_ZETA", 20.0, 9))
        answers = {m.get_type() for m in ground.listen(0.5)} & {"COMMAND_ACK", "PARAM_VALUE"}
        assert not answers
        flight = up.land()
        ground.close()
    assert [c.kind for _, c in flight.commands] == ["end"]  # ours
    assert up.live.statistics.ignored == 2
