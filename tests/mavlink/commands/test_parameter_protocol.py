"""Parameters on a real socket."""

import struct

import pytest
from pymavlink.dialects.v20 import common as dialect

from tests.mavlink.ground import Ground, aloft


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
        assert put("TRIM_ZETA", 30.0, dialect.MAV_PARAM_TYPE_REAL64) == 20.0
        assert put("TRIM_ZETA", 2000.0) == 20.0
        texts = [m.text for m in ground.heard if m.get_type() == "STATUSTEXT"]
        assert texts[-1] == "refused: TRIM_ZETA: expected at most 1000"
        assert "refused: FAIL_EFF: expected 0 to 1" in texts
        assert put("TRIM_ZETA", 30.0, dialect.MAV_PARAM_TYPE_INT32) == 30.0  # as its value ...
        in_bytes = struct.unpack("<f", struct.pack("<i", 40))[0]
        answer = put("TRIM_ZETA", in_bytes, dialect.MAV_PARAM_TYPE_INT32)  # ... or in its bytes
        assert struct.unpack("<i", struct.pack("<f", answer))[0] == 40
        for index, name in ((-1, b"NO_SUCH"), (999, b"")):
            ground.send(dialect.MAVLink_param_request_read_message(1, 1, name, index))
            error = ground.wait_for("PARAM_ERROR").error
            assert error == dialect.MAV_PARAM_ERROR_DOES_NOT_EXIST
        ground.send(dialect.MAVLink_param_set_message(1, 1, b"NO_SUCH", 1.0, 9))
        ground.wait_for("PARAM_ERROR")
        flight = up.land()
        ground.close()
    assert [(c.key, c.value) for _, c in flight.commands[:-1]] == [
        ("trim_filter", value) for value in (20.0, 30.0, 40.0)
    ]
