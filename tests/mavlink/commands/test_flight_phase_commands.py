"""Pause, resume, end, arming, on a real socket."""

from pymavlink.dialects.v20 import common as dialect

from tests.mavlink.ground import Ground, aloft

ACCEPTED, REJECTED = 0, 1


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
