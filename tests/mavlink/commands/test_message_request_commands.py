"""Messages on request and at other rates, on a real socket."""

import numpy as np
from pymavlink.dialects.v20 import common as dialect

from tests.mavlink.ground import Ground, aloft

ACCEPTED, DENIED, UNSUPPORTED = 0, 2, 3


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
