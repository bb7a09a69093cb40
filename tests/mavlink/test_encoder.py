"""Values that do not fit are clamped and counted; frames are what the library reads."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.link.encoder import Encoder
from ftc_jsb.mavlink.telemetry.geodesy import latitude_longitude
from ftc_jsb.mavlink.telemetry.snapshot import Counters, Observatory, Phase
from ftc_jsb.mavlink.telemetry.streams import STREAMS, contents
from ftc_jsb.recording.columns import ROW
from ftc_jsb.scenario.load import load_scenario

OBSERVATORY = Observatory(load_scenario("paper"))


def decoded(frame: bytes):
    return dialect.MAVLink(None).parse_buffer(frame)[0]


def test_velocity_beyond_its_field_is_clamped_and_counted():
    """340 m/s north does not fit 16 bits of cm/s."""
    encoder = Encoder(1)
    fields = {"vx": 34000.0, "vy": -34000.0, "vz": 12.4, "lat": 470000000.2}
    message = decoded(encoder.frame(dialect.MAVLink_global_position_int_message, fields))
    assert (message.vx, message.vy, message.vz, message.lat) == (32767, -32768, 12, 470000000)
    assert encoder.clamped == 2


@given(st.floats() | st.integers(-(2**70), 2**70))
def test_no_number_is_too_much(value):
    encoder = Encoder(1)
    for message in (
        dialect.MAVLink_hil_state_quaternion_message,
        dialect.MAVLink_sys_status_message,
        dialect.MAVLink_debug_float_array_message,
        dialect.MAVLink_gps_raw_int_message,
        dialect.MAVLink_autopilot_version_message,
    ):
        names = [
            n for n, t in zip(message.fieldnames, message.fieldtypes, strict=True) if t != "char"
        ]
        decoded(encoder.frame(message, dict.fromkeys(names, float(value))))


def test_texts_are_cut_to_their_field_and_made_ascii():
    text = decoded(
        Encoder(1).frame(
            dialect.MAVLink_statustext_message, {"severity": 4, "text": "χ" + "x" * 60}
        )
    )
    assert text.text == "?" + "x" * 49


@pytest.mark.parametrize("model", ["paper", "identified", "jsbsim"])
def test_every_message_can_be_made_of_every_row(flown, model):
    """Rows of the paper's flight, its last without commands included; as many frames as read back."""
    flight = flown("paper", f"model={model}")
    observatory, encoder = Observatory(flight.scenario), Encoder(7)
    for i in (0, 1, 2500, flight.record.size - 1):
        snapshot = observatory.at(flight.record, i, Phase.FLYING, 1e9, Counters())
        for stream in STREAMS:
            for fields in contents(stream, snapshot):
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
        snapshot = OBSERVATORY.at(record, 1, Phase.FLYING, 1e9, Counters())
    except (ValueError, OverflowError, ZeroDivisionError):
        pytest.fail("no snapshot")
    encoder = Encoder(1)
    for stream in STREAMS:
        for fields in contents(stream, snapshot):
            decoded(encoder.frame(stream.message, fields))


def test_messages_say_what_the_row_says(flown):
    """A row of the F-16 in a banked climb, in MAVLink's units and signs."""
    flight = flown("paper", "model=jsbsim")
    row = flight.record[2200]
    snapshot = Observatory(flight.scenario).at(flight.record, 2200, Phase.FLYING, 1e9, Counters())
    found = {}
    for stream in STREAMS:
        for fields in contents(stream, snapshot):
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


@pytest.mark.parametrize("model", ["paper", "jsbsim"])
def test_position_on_the_globe_is_jsbsims(flown, model):
    """The tangent plane's point as latitude and longitude: as far from the origin as it was flown.

    60 s at 300 m/s: the haversine distance on JSBSim's ellipsoid within 0.4 %, and the bearing 0.3 deg.
    """
    flight = flown("paper", f"model={model}")
    i = flight.record.size - 1
    row = flight.record[i]
    origin = (47.0, 8.0, 3048.0)
    latitude, longitude = latitude_longitude(row["north"], row["east"], row["altitude"], origin)
    north = math.radians(latitude - 47.0) * 6.3715e6  # [m] a radian at 47 deg
    east = math.radians(longitude - 8.0) * 6.3895e6 * math.cos(math.radians(47.0))
    assert math.hypot(north, east) == pytest.approx(math.hypot(row["north"], row["east"]), rel=4e-3)
    assert math.atan2(east, north) == pytest.approx(math.atan2(row["east"], row["north"]), abs=5e-3)
