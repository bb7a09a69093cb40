"""The vehicle on real sockets: it is seen, it answers everything once, and nothing holds it up."""

import socket
import time
from collections import Counter

import numpy as np
import pytest
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.errors import LinkError
from ftc_jsb.mavlink.link.endpoint import Endpoint, opened, parse_endpoint
from ftc_jsb.mavlink.telemetry.streams import STREAMS, Timetable
from ftc_jsb.recording.columns import ROW
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from ftc_jsb.simulation.replay import differences, replay
from tests.mavlink.ground import HOST, Ground, aloft, free_port

ACCEPTED, REJECTED, DENIED, UNSUPPORTED = 0, 1, 2, 3


def test_timetable_keeps_the_rates():
    """100 s of a clock that the test turns: each message as often as it should be, to one."""
    now = 0.0
    timetable = Timetable(lambda: now)
    sent = Counter()
    while now < 100.0:
        sent.update(stream.id for stream in timetable.due())
        now = max(timetable.next(), now + 1e-3)
    for stream in STREAMS:
        assert sent[stream.id] == pytest.approx(100.0 * stream.rate, abs=1), stream.message.msgname


def test_late_messages_are_not_made_up_for():
    """After a second in which nothing ran, one of each, not 25."""
    now = 0.0
    timetable = Timetable(lambda: now)
    now = 10.0
    assert len(timetable.due()) == len({stream.id for stream in STREAMS if stream.rate})
    assert timetable.due() == []


@pytest.mark.parametrize("stream", [False, True], ids=["udpin", "tcpin"])
def test_every_stream_is_heard(stream):
    """Of the F-16, heartbeat and identity included."""
    wanted = {s.id for s in STREAMS if s.rate}
    with aloft("model=jsbsim", kind="tcpin" if stream else "udpin") as up:
        ground = Ground(up.port, stream=stream)
        until = time.monotonic() + 20.0
        while time.monotonic() < until and not wanted <= {m.get_msgId() for m in ground.heard}:
            ground.listen(0.2)
        ground.close()
    heard = ground.heard
    assert wanted <= {message.get_msgId() for message in heard}
    beat = next(m for m in heard[::-1] if m.get_type() == "HEARTBEAT")
    assert (beat.type, beat.autopilot, beat.base_mode, beat.custom_mode) == (1, 0, 217, 15)
    assert beat.get_srcComponent() == 1
    state = next(m for m in heard[::-1] if m.get_type() == "EXTENDED_SYS_STATE")
    assert state.landed_state == dialect.MAV_LANDED_STATE_IN_AIR


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


def test_set_points_by_command_are_flown_recorded_and_replayed():
    """Speed by COMMAND_LONG, heading and altitude by COMMAND_INT, flight path by USER_1; at 20 x."""
    with aloft(factor=20.0) as up:
        ground = Ground(up.port)
        ground.wait_for("ATTITUDE")
        assert ground.ask(dialect.MAV_CMD_DO_CHANGE_SPEED, 0, 290.0, -1) == ACCEPTED
        ground.send(
            dialect.MAVLink_command_int_message(
                1, 1, 0, dialect.MAV_CMD_GUIDED_CHANGE_HEADING, 0, 0, 1, 90.0, 20.0, 0, 0, 0, 0
            )
        )
        assert ground.wait_for("COMMAND_ACK").result == ACCEPTED
        assert ground.ask(dialect.MAV_CMD_DO_CHANGE_ALTITUDE, 3200.0, 0) == ACCEPTED
        assert ground.ask(dialect.MAV_CMD_DO_CHANGE_ALTITUDE, 3200.0, 99) == DENIED
        assert ground.ask(dialect.MAV_CMD_DO_CHANGE_SPEED, 0, 900.0, -1) == DENIED
        assert ground.ask(dialect.MAV_CMD_DO_CHANGE_SPEED, 0, float("nan"), -1) == DENIED
        assert ground.ask(dialect.MAV_CMD_DO_CHANGE_SPEED, 2, 10.0, -1) == UNSUPPORTED
        ground.listen(4.0)  # 80 s of flight
        assert ground.ask(dialect.MAV_CMD_USER_1, -2.0) == ACCEPTED
        ground.listen(0.7)
        flight = up.land()
        ground.close()
    row, settled = flight.record[-1], flight.record[flight.record["time"] > 70.0][0]
    assert settled["airspeed"] == pytest.approx(290.0, abs=0.1)
    assert settled["altitude"] == pytest.approx(3200.0, abs=1.0)
    assert np.degrees(row["heading"]) == pytest.approx(90.0, abs=0.1)
    assert np.degrees(row["flight_path_angle"]) == pytest.approx(-2.0, abs=0.1)
    assert differences(flight, replay(flight)) == []


def test_pause_resume_end_and_reset_have_their_states():
    """ACTIVE, still while paused, STANDBY and disarmed at the end, and the heartbeat goes on."""
    with aloft() as up:
        ground = Ground(up.port)
        ground.wait_for("ATTITUDE")
        assert ground.ask(dialect.MAV_CMD_COMPONENT_ARM_DISARM, 0) == REJECTED
        assert "in the air" in ground.wait_for("STATUSTEXT").text
        assert ground.ask(dialect.MAV_CMD_DO_PAUSE_CONTINUE, 0) == ACCEPTED
        still = 0
        for _ in range(500):  # until one sample is told twice
            before, still = still, ground.wait_for("ATTITUDE").time_boot_ms
            if still == before:
                break
        times = {m.time_boot_ms for m in ground.listen(0.5) if m.get_type() == "ATTITUDE"}
        assert times <= {still}
        assert ground.ask(dialect.MAV_CMD_DO_PAUSE_CONTINUE, 1) == ACCEPTED
        ground.wait_for("ATTITUDE", lambda m: m.time_boot_ms > still)
        assert ground.ask(dialect.MAV_CMD_DO_FLIGHTTERMINATION, 1) == ACCEPTED
        beat = ground.wait_for("HEARTBEAT", lambda m: m.system_status == dialect.MAV_STATE_STANDBY)
        assert not beat.base_mode & dialect.MAV_MODE_FLAG_SAFETY_ARMED
        assert ground.ask(dialect.MAV_CMD_DO_CHANGE_SPEED, 0, 290.0) == REJECTED
        assert ground.ask(dialect.MAV_CMD_DO_FLIGHTTERMINATION, 1) == ACCEPTED
        ground.wait_for("HEARTBEAT", within=1.5)
        flight = up.flight
        ground.close()
    assert [command.kind for _, command in flight.commands] == ["pause", "resume", "end"]
    assert flight.outcome.status == "ended"


def test_messages_on_request_and_at_other_rates():
    with aloft() as up:
        ground = Ground(up.port)
        ground.wait_for("ATTITUDE")
        interval = dialect.MAV_CMD_SET_MESSAGE_INTERVAL
        attitude = dialect.MAVLink_attitude_message.id
        assert ground.ask(interval, attitude, 100_000) == ACCEPTED
        ground.command(dialect.MAV_CMD_GET_MESSAGE_INTERVAL, attitude)
        assert ground.wait_for("MESSAGE_INTERVAL").interval_us == 100_000
        times = [ground.wait_for("ATTITUDE").time_boot_ms for _ in range(12)]
        assert 80 <= np.median(np.diff(times[2:])) <= 200
        assert ground.ask(interval, attitude, -1) == ACCEPTED
        ground.listen(0.2)
        assert not [m for m in ground.listen(0.5) if m.get_type() == "ATTITUDE"]
        assert ground.ask(interval, dialect.MAVLink_heartbeat_message.id, -1) == DENIED
        assert ground.ask(interval, 9999, 1000) == UNSUPPORTED
        assert ground.ask(interval, attitude, 100) == DENIED  # 10 kHz
        assert ground.ask(interval, attitude, float("nan")) == DENIED
        request = dialect.MAV_CMD_REQUEST_MESSAGE
        ground.command(request, dialect.MAVLink_autopilot_version_message.id)
        version = ground.wait_for("AUTOPILOT_VERSION")
        assert version.capabilities & dialect.MAV_PROTOCOL_CAPABILITY_MAVLINK2
        ground.command(request, dialect.MAVLink_attitude_quaternion_message.id)
        ground.wait_for("ATTITUDE_QUATERNION")
        ground.send(dialect.MAVLink_request_data_stream_message(1, 1, 0, 1, 1))  # all at 1 Hz
        ground.listen(0.5)
        times = [ground.wait_for("ATTITUDE_TARGET").time_boot_ms for _ in range(3)]
        assert np.diff(times).min() >= 500
        ground.close()


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


def test_parameters_are_listed_read_set_and_guarded():
    with aloft() as up:
        ground = Ground(up.port)
        ground.wait_for("ATTITUDE")
        ground.send(dialect.MAVLink_param_request_list_message(1, 1))
        first = ground.wait_for("PARAM_VALUE")
        listed = {first.param_id: first.param_value}
        while len(listed) < first.param_count:
            message = ground.wait_for("PARAM_VALUE")
            listed[message.param_id] = message.param_value
        assert listed["TRIM_ZETA"] == 50.0

        def put(name, value, kind=dialect.MAV_PARAM_TYPE_REAL32):
            ground.send(dialect.MAVLink_param_set_message(1, 1, name.encode(), value, kind))
            return ground.wait_for("PARAM_VALUE").param_value

        assert put("TRIM_ZETA", 20.0) == 20.0
        for bad in (-1.0, 1e9, float("nan"), float("inf")):
            assert put("TRIM_ZETA", bad) == 20.0
            assert ground.heard[-2].get_type() in ("PARAM_ERROR", "STATUSTEXT")
        assert put("FAIL_EFF", 1.01) == pytest.approx(0.6)
        assert put("SYS_FAILURE_EN", 0.5) == 0.0
        assert put("TRIM_ZETA", 30.0, dialect.MAV_PARAM_TYPE_INT32) == 20.0
        for index, name in ((-1, b"NO_SUCH"), (999, b"")):
            ground.send(dialect.MAVLink_param_request_read_message(1, 1, name, index))
            error = ground.wait_for("PARAM_ERROR").error
            assert error == dialect.MAV_PARAM_ERROR_DOES_NOT_EXIST
        ground.send(dialect.MAVLink_param_set_message(1, 1, b"NO_SUCH", 1.0, 9))
        ground.wait_for("PARAM_ERROR")
        flight = up.land()
        ground.close()
    assert [(c.key, c.value) for _, c in flight.commands[:-1]] == [("trim_filter", 20.0)]


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


def test_readonly_link_ignores_everything_and_still_tells():
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
    assert up.live.tally.ignored == 2


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


def test_endpoints_are_read_and_bad_ones_refused():
    assert parse_endpoint("udpin::14550") == Endpoint("udpin", "127.0.0.1", 14550)
    assert not parse_endpoint("tcpin:0.0.0.0:5760").is_local
    for bad in ("udp:127.0.0.1:14550", "udpout:127.0.0.1", "udpin:host:70000", "tcpin:a:b", ""):
        with pytest.raises(LinkError, match="expected udpout"):
            parse_endpoint(bad)
    port = free_port()
    with opened(Endpoint("udpin", HOST, port)), pytest.raises(LinkError, match="in use"):
        opened(Endpoint("udpin", HOST, port))


def test_silent_udp_peer_is_no_longer_sent_to(monkeypatch):
    monkeypatch.setattr("ftc_jsb.mavlink.link.transport.SILENCE", 0.5)
    with aloft() as up:
        ground = Ground(up.port)
        ground.wait_for("ATTITUDE")
        ground.silent = True
        ground.listen(1.0)
        assert ground.listen(0.3) == []
        ground.beat()
        ground.wait_for("ATTITUDE")
        ground.close()
