"""Set-points by command, on a real socket."""

import numpy as np
import pytest
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.simulation.replay import differences, replay
from tests.mavlink.ground import Ground, aloft

ACCEPTED, DENIED, UNSUPPORTED = 0, 2, 3


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
