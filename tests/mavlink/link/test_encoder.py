"""Values that do not fit are clamped and counted; frames are what the library reads."""

from hypothesis import given
from hypothesis import strategies as st
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.link.encoder import Encoder
from tests.mavlink.frames import decoded


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
