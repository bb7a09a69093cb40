"""What stations ask is answered, what is refused is named, and what fails on board shows."""

import math

import numpy as np
import pytest
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.link.encoder import Encoder
from ftc_jsb.mavlink.telemetry import motion_messages as motion
from ftc_jsb.mavlink.telemetry import outer_loop_messages as outer_loop
from ftc_jsb.mavlink.telemetry import status_messages as status
from ftc_jsb.mavlink.telemetry.flight_events import FlightEvents
from ftc_jsb.mavlink.telemetry.snapshot import LinkHealth, Phase, SnapshotBuilder
from ftc_jsb.vocabulary.signals import SENSED
from tests.mavlink.frames import decoded
from tests.mavlink.ground import Ground, aloft


def test_clock_is_the_vehicles():
    """TIMESYNC [ns] is the time of flight, which the messages are stamped with, and stands while paused."""
    with aloft() as up:
        ground = Ground(up.port)
        stamp = ground.wait_for("ATTITUDE").time_boot_ms
        ground.send(dialect.MAVLink_timesync_message(0, 12345))
        answer = ground.wait_for("TIMESYNC")
        assert answer.ts1 == 12345
        assert 0.0 <= answer.tc1 / 1e6 - stamp < 2000.0  # ms
        assert ground.wait_for("ATTITUDE").time_boot_ms >= answer.tc1 / 1e6 - 1.0


def test_every_request_is_answered_and_every_refusal_names_its_command():
    with aloft() as up:
        ground = Ground(up.port)
        ground.wait_for("ATTITUDE")
        ground.send(dialect.MAVLink_log_request_list_message(1, 1, 0, 0xFFFF))
        assert ground.wait_for("LOG_ENTRY").num_logs == 0
        ground.send(dialect.MAVLink_log_request_data_message(1, 1, 3, 0, 90))
        assert ground.wait_for("LOG_DATA").count == 0
        ground.send(dialect.MAVLink_mission_set_current_message(1, 1, 2))
        assert ground.wait_for("MISSION_ACK").type == dialect.MAV_MISSION_INVALID_SEQUENCE
        ground.send(dialect.MAVLink_mission_request_partial_list_message(1, 1, 0, 3))
        ground.wait_for("MISSION_ACK")
        for _ in range(5):
            ground.send(
                dialect.MAVLink_set_attitude_target_message(0, 1, 1, 0, [1, 0, 0, 0], 0, 0, 0, 0.5)
            )
        said = ground.wait_for("STATUSTEXT", lambda m: "ATTITUDE" in m.text).text
        assert said == "refused: ATTITUDE_TARGET: not followed"
        assert ground.ask(dialect.MAV_CMD_DO_CHANGE_SPEED, 0, 900.0) == dialect.MAV_RESULT_DENIED
        said = ground.wait_for("STATUSTEXT", lambda m: "refused" in m.text).text
        assert said == "refused: CHANGE_SPEED: value at most 600"
        ground.ask(dialect.MAV_CMD_NAV_LAND)
        said = ground.wait_for("STATUSTEXT", lambda m: "refused" in m.text).text
        assert said == "refused: NAV_LAND: unsupported"


@pytest.fixture
def taken(flown):
    """Snapshots of rows of a flight of the F-16, changed."""
    flight = flown("paper", "model=jsbsim")
    snapshots = SnapshotBuilder(flight.scenario)

    def take(i=2500, **changes):
        record = flight.record[i : i + 1].copy()
        for name, value in changes.items():
            record[name] = value
        return snapshots.at(record, 0, Phase.FLYING, 0.0, LinkHealth())

    return take


def health(snapshot):
    return decoded(
        Encoder(1).frame(dialect.MAVLink_sys_status_message, status.sys_status(snapshot))
    )


SENSORS = pytest.mark.parametrize(
    ("signal", "bit"),
    [
        ("airspeed", dialect.MAV_SYS_STATUS_SENSOR_DIFFERENTIAL_PRESSURE),
        ("altitude", dialect.MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE),
        ("north", dialect.MAV_SYS_STATUS_SENSOR_GPS),
        ("roll_rate", dialect.MAV_SYS_STATUS_SENSOR_3D_GYRO),
        ("load_factor_x", dialect.MAV_SYS_STATUS_SENSOR_3D_ACCEL),
    ],
)


@SENSORS
def test_excluded_sensor_is_unhealthy_though_it_reads(taken, signal, bit):
    """Frozen, biased or drifting: isolation tells by `excluded`, whose bits are in the order of the sensors."""
    bits = float(1 << SENSED.index(signal))
    sound, excluded = health(taken()), health(taken(excluded=bits))
    assert sound.onboard_control_sensors_health & bit
    lost = sound.onboard_control_sensors_health & ~excluded.onboard_control_sensors_health
    assert lost == bit
    fix = motion.gps_raw_int(taken(excluded=bits))["fix_type"]
    none = dialect.GPS_FIX_TYPE_NO_FIX
    assert fix == (none if signal == "north" else dialect.GPS_FIX_TYPE_3D_FIX)


def test_excluded_attitude_is_the_ahrs_and_heading_the_magnetometer(taken):
    bits = float(1 << SENSED.index("yaw"))
    seen = health(taken(excluded=bits)).onboard_control_sensors_health
    assert not seen & dialect.MAV_SYS_STATUS_AHRS
    assert not seen & dialect.MAV_SYS_STATUS_SENSOR_3D_MAG
    assert seen & dialect.MAV_SYS_STATUS_SENSOR_3D_GYRO


def test_a_loop_without_isolation_excludes_nothing(taken):
    every = health(taken()).onboard_control_sensors_health
    assert health(taken(excluded=math.nan)).onboard_control_sensors_health == every


@SENSORS
def test_sensor_without_a_reading_is_unhealthy(taken, signal, bit):
    sound, silent = health(taken()), health(taken(**{f"{signal}_meas": math.nan}))
    assert sound.onboard_control_sensors_health & bit
    assert not silent.onboard_control_sensors_health & bit
    assert silent.onboard_control_sensors_present & bit
    fix = motion.gps_raw_int(taken(**{f"{signal}_meas": math.nan}))["fix_type"]
    none = dialect.GPS_FIX_TYPE_NO_FIX
    assert fix == (none if signal == "north" else dialect.GPS_FIX_TYPE_3D_FIX)


def test_what_is_not_there_is_not_said_to_be(taken):
    assert not health(taken()).onboard_control_sensors_present & dialect.MAV_SYS_STATUS_GEOFENCE


def test_measured_stands_beside_true_and_innovations_are_the_filters(taken):
    snapshot = taken(airspeed_meas=287.5, airspeed_innovation=0.6, airspeed_innovation_std=0.1)
    numbers = {f["name"]: f["value"] for f in outer_loop.named_value_float(snapshot)}
    assert numbers["TAS_M"] == 287.5
    assert numbers["TAS"] == snapshot.row["airspeed"]
    assert outer_loop.estimator_status(snapshot)["tas_ratio"] == pytest.approx(2.0)
    blind = outer_loop.estimator_status(taken(airspeed_innovation_std=math.nan))
    assert math.isnan(blind["tas_ratio"])
    assert blind["flags"] == 0
    given_up = taken(climb_given_up=math.radians(3.0), turn_given_up=math.radians(2.0))
    numbers = {f["name"]: f["value"] for f in outer_loop.named_value_float(given_up)}
    assert (numbers["CLIMB_LOST"], numbers["TURN_LOST"]) == (pytest.approx(3.0), pytest.approx(2.0))


def test_heartbeat_is_critical_while_a_limit_is_broken_and_after_control_is_lost(flown, taken):
    flight = flown("paper", "model=jsbsim")
    events = FlightEvents(flight.scenario)
    record = flight.record[:3000].copy()
    events.find(record, 0, 1000)
    assert not events.critical
    assert status.heartbeat(taken())["system_status"] == dialect.MAV_STATE_ACTIVE
    record["altitude"][1000:1100] = -50.0  # m: below the ground
    events.find(record, 1000, 1050)
    assert events.critical
    events.find(record, 1050, 1200)
    assert not events.critical
    record["bank_angle"][1200:1300] = np.pi
    found = events.find(record, 1200, 1300)
    assert "control lost: inverted" in [event.text for event in found]
    events.find(record, 1300, 2990)
    assert events.critical
    danger = status.heartbeat(taken()._replace(critical=True))
    assert danger["system_status"] == dialect.MAV_STATE_CRITICAL
