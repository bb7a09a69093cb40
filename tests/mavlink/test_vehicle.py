"""The vehicle on real sockets is seen with every stream."""

import time

import pytest
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.telemetry.message_streams import STREAMS
from tests.mavlink.ground import Ground, aloft


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
