"""Messages of the rows of a flight: each can be made of every row, and says what the row says."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ftc_jsb.mavlink.link.encoder import Encoder
from ftc_jsb.mavlink.telemetry.message_streams import STREAMS, message_fields
from ftc_jsb.mavlink.telemetry.snapshot import LinkHealth, Phase, SnapshotBuilder
from ftc_jsb.recording.columns import ROW
from ftc_jsb.scenario.load import load_scenario
from tests.mavlink.frames import decoded

SNAPSHOTS = SnapshotBuilder(load_scenario("paper"))


@pytest.mark.parametrize("model", ["paper", "identified", "jsbsim"])
def test_every_message_can_be_made_of_every_row(flown, model):
    """Rows of the paper's flight, its last without commands included; as many frames as read back."""
    flight = flown("paper", f"model={model}")
    snapshots, encoder = SnapshotBuilder(flight.scenario), Encoder(7)
    for i in (0, 1, 2500, flight.record.size - 1):
        snapshot = snapshots.at(flight.record, i, Phase.FLYING, 1e9, LinkHealth())
        for stream in STREAMS:
            for fields in message_fields(stream, snapshot):
                message = decoded(encoder.frame(stream.message, fields))
                assert message.get_msgId() == stream.id
                assert message.get_srcSystem() == 7
    assert encoder.clamped == 0


@given(st.lists(st.floats(), min_size=len(ROW.names), max_size=len(ROW.names)))
def test_no_state_is_too_wild(values):
    """Rows of anything at all: a departed flight is still told."""
    record = np.zeros(2, ROW)
    record[1] = tuple(values)
    try:
        snapshot = SNAPSHOTS.at(record, 1, Phase.FLYING, 1e9, LinkHealth())
    except (ValueError, OverflowError, ZeroDivisionError):
        pytest.fail("no snapshot")
    encoder = Encoder(1)
    for stream in STREAMS:
        for fields in message_fields(stream, snapshot):
            decoded(encoder.frame(stream.message, fields))


def test_messages_say_what_the_row_says(flown):
    """A row of the F-16 in a banked climb, in MAVLink's units and signs."""
    flight = flown("paper", "model=jsbsim")
    row = flight.record[2200]
    snapshot = SnapshotBuilder(flight.scenario).at(
        flight.record, 2200, Phase.FLYING, 1e9, LinkHealth()
    )
    found = {}
    for stream in STREAMS:
        for fields in message_fields(stream, snapshot):
            message = decoded(Encoder(1).frame(stream.message, fields))
            found[message.get_type()] = message
            if message.get_type() == "NAMED_VALUE_FLOAT":
                found[message.name] = message.value
    assert found["ATTITUDE"].roll == pytest.approx(row["roll"], abs=1e-6)
    assert found["VFR_HUD"].airspeed == pytest.approx(row["airspeed"], rel=1e-6)
    position = found["GLOBAL_POSITION_INT"]
    assert position.alt == pytest.approx(1e3 * row["altitude"], abs=1.0)
    speed = math.sqrt(position.vx**2 + position.vy**2 + position.vz**2) / 100.0
    assert speed == pytest.approx(row["airspeed"], abs=0.02)
    assert position.vz == pytest.approx(
        -100.0 * row["airspeed"] * math.sin(row["flight_path_angle"]), abs=1.0
    )
    assert found["BANK"] == pytest.approx(math.degrees(row["bank_angle"]), rel=1e-5)
    assert found["EFF_THR"] == pytest.approx(row["effectiveness_thrust_est"], rel=1e-6)
    truth = found["HIL_STATE_QUATERNION"]
    w, x, y, z = truth.attitude_quaternion
    up = 2.0 * (x * z - w * y)  # minus the body's x axis, down
    assert -up == pytest.approx(math.sin(row["pitch"]), abs=1e-5)
    assert truth.zacc == pytest.approx(-1e3 * row["load_factor_z"], abs=15.0)  # mg
    assert truth.xacc == pytest.approx(1e3 * row["load_factor_x"], abs=15.0)
