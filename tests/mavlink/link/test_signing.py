"""A link with a key: what is not signed by it, or has been heard before, does nothing and is counted."""

import hashlib

import pytest
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.errors import LinkError
from ftc_jsb.mavlink.link.encoder import signing_time
from ftc_jsb.mavlink.link.receiver import Receiver
from ftc_jsb.mavlink.link.signing import load_key
from tests.mavlink.ground import Ground, aloft

KEY, OTHER = hashlib.sha256(b"correct horse").digest(), hashlib.sha256(b"another").digest()
END = dialect.MAVLink_command_long_message(1, 1, 185, 0, 1, 0, 0, 0, 0, 0, 0)


def sender(key, time=None):
    mav = dialect.MAVLink(None, 255, 190)
    if key is not None:
        mav.signing.secret_key, mav.signing.sign_outgoing = key, True
        mav.signing.timestamp = signing_time() if time is None else time
    return mav


def beat(mav) -> bytes:
    return dialect.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3).pack(mav)


def test_only_the_holder_of_the_key_is_obeyed():
    with aloft(key=KEY) as up:
        plain, wrong, right = Ground(up.port), Ground(up.port, OTHER), Ground(up.port, KEY)
        right.wait_for("ATTITUDE")
        for ground in (plain, wrong):
            ground.silent = True
            ground.send(END)
            assert not ground.listen(0.5)  # not even told anything
        assert right.ask(dialect.MAV_CMD_DO_CHANGE_SPEED, 0, 290.0) == 0
        assert all(message.get_signed() for message in right.heard)
        captured = right.frame(END)
        flight_goes_on = up.flight is None
        right.socket.send(captured)
        right.wait_for("COMMAND_ACK", lambda ack: ack.command == 185)
        flight = up.land()
        for ground in (plain, wrong, right):
            ground.close()
    assert flight_goes_on
    assert [command.kind for _, command in flight.commands] == ["set-airspeed", "end"]
    assert up.live.statistics.refused == 4


def test_replayed_frame_is_refused():
    receiver, mav = Receiver(KEY), sender(KEY)
    first, second = beat(mav), beat(mav)
    assert len(receiver.messages("a", first, False)) == 1
    assert len(receiver.messages("a", second, False)) == 1
    for old in (first, second):
        assert receiver.messages("b", old, False) == []
    assert (receiver.received, receiver.refused) == (2, 2)


def test_old_frame_of_a_stream_not_heard_before_is_refused():
    """More than a minute old: captured in an earlier flight."""
    receiver = Receiver(KEY)
    old = sender(KEY, signing_time() - 61 * 100_000)
    assert receiver.messages("a", beat(old), False) == []


def test_forged_frame_from_the_future_does_not_shut_the_sender_out():
    receiver = Receiver(KEY)
    assert receiver.messages("a", beat(sender(OTHER, signing_time() + 10**9)), False) == []
    assert len(receiver.messages("a", beat(sender(KEY)), False)) == 1


def test_damaged_signature_and_unsigned_frames_are_refused():
    receiver, mav = Receiver(KEY), sender(KEY)
    frame = bytearray(beat(mav))
    frame[-1] ^= 1
    assert receiver.messages("a", bytes(frame), False) == []
    assert receiver.messages("a", beat(sender(None)), False) == []
    assert receiver.refused == 2


def test_key_is_the_hash_of_a_pass_phrase_in_a_file(tmp_path):
    path = tmp_path / "key"
    path.write_text("correct horse\n")
    assert load_key(path) == KEY
    for bad in ("short", "", "two lines\nof text"):
        path.write_text(bad)
        with pytest.raises(LinkError, match="pass phrase"):
            load_key(path)
    with pytest.raises(LinkError, match="cannot be read"):
        load_key(tmp_path / "none")
