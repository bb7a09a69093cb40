"""Which failures of MAVLink the aircraft can have, and what they do to it."""

import math

import numpy as np
import pytest
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.commands.failure_faults import Failure, faults_of_failure
from ftc_jsb.recording.commands import Applied
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.assembly import point_mass_of
from ftc_jsb.simulation.command_source import RecordedCommands
from ftc_jsb.simulation.fly import fly
from ftc_jsb.simulation.replay import differences, replay
from tests.mavlink.ground import Ground, aloft

MOTOR, SERVO = dialect.FAILURE_UNIT_SYSTEM_MOTOR, dialect.FAILURE_UNIT_SYSTEM_SERVO
AIRSPEED, GYRO = dialect.FAILURE_UNIT_SENSOR_AIRSPEED, dialect.FAILURE_UNIT_SENSOR_GYRO
OK, OFF, STUCK, GARBAGE, WRONG, SLOW, DELAYED = 0, 1, 2, 3, 4, 5, 6


def made(model, unit, kind, instance=1):
    scenario = load_scenario("nominal", [f"model={model}", "duration=4"])
    engines = point_mass_of(scenario).thrust.engines
    return scenario, faults_of_failure(scenario, engines, Failure(unit, kind, instance, 0.6, 0.5))


@pytest.mark.parametrize(
    ("unit", "kind", "instance", "on_a_point_mass", "on_jsbsim"),
    [
        (MOTOR, SLOW, 0, True, True),
        (MOTOR, SLOW, 1, True, True),
        (MOTOR, SLOW, 2, False, False),  # the F-16 has one engine
        (MOTOR, OFF, 1, True, True),
        (MOTOR, STUCK, 1, False, True),  # a point mass has no throttle
        (MOTOR, GARBAGE, 1, False, False),
        (MOTOR, OK, 1, True, True),
        (SERVO, SLOW, 1, False, True),
        (SERVO, STUCK, 2, False, True),
        (SERVO, WRONG, 3, False, True),
        (SERVO, OFF, 4, False, False),
        (AIRSPEED, OFF, 1, True, True),
        (AIRSPEED, STUCK, 1, True, True),
        (AIRSPEED, DELAYED, 0, True, True),
        (AIRSPEED, SLOW, 1, False, False),
        (GYRO, OFF, 1, False, True),
        (dialect.FAILURE_UNIT_SYSTEM_BATTERY, OFF, 1, False, False),
        (-1, OFF, 1, False, False),
        (MOTOR, 99, 1, False, False),
        (MOTOR, SLOW, -1, False, False),
    ],
)  # fmt: skip
def test_what_can_fail(unit, kind, instance, on_a_point_mass, on_jsbsim):
    for model, expected in (("paper", on_a_point_mass), ("jsbsim", on_jsbsim)):
        assert (made(model, unit, kind, instance)[1] is not None) == expected, model


@pytest.mark.parametrize(
    ("model", "unit", "kind", "column", "value"),
    [
        ("paper", MOTOR, OFF, "engine_0_effectiveness", 0.0),
        ("jsbsim", MOTOR, OFF, "engine_0_state", 1.0),
        ("jsbsim", MOTOR, STUCK, "engine_0_state", 2.0),
        ("jsbsim", SERVO, SLOW, "elevator_effectiveness", 0.6),
        ("jsbsim", SERVO, STUCK, "elevator_state", 2.0),
    ],
)
def test_failure_acts_from_its_row_to_its_healing_and_replays(model, unit, kind, column, value):
    """Injected before row 100, healed before row 300."""
    scenario, command = made(model, unit, kind)
    healed = made(model, unit, OK)[1]
    given = RecordedCommands([Applied(100, command), Applied(300, healed)])
    flight = fly(scenario, commands=given)
    before = flight.record[column][99]
    assert set(flight.record[column][100:300]) == {value} != {before}
    assert set(flight.record[column][300:]) == {before}
    assert differences(flight, replay(flight)) == []


def test_failed_sensor_is_seen_by_the_loop_and_replays():
    """Airspeed frozen at 1 s, in a flight that began 5 m/s off its reference."""
    scenario, command = made("paper", AIRSPEED, STUCK)
    scenario = load_scenario("nominal", ["duration=4", "initial.airspeed=295"])
    flight = fly(scenario, commands=RecordedCommands([Applied(100, command)]))
    assert len(set(flight.record["airspeed_meas"][100:400])) == 1
    assert len(set(flight.record["airspeed"][100:400])) > 100
    assert differences(flight, replay(flight)) == []


def test_failures_by_command_are_gated_idempotent_and_told():
    """Parameters 4 to 7 are NaN from MAVSDK and 0 from MAVProxy; the same twice is one fault."""
    with aloft("model=jsbsim") as up:
        ground = Ground(up.port)
        ground.wait_for("ATTITUDE")
        inject = dialect.MAV_CMD_INJECT_FAILURE
        nan = math.nan
        assert ground.ask(inject, MOTOR, SLOW, 1, nan, nan, nan, nan) == dialect.MAV_RESULT_DENIED
        ground.send(dialect.MAVLink_param_set_message(1, 1, b"SYS_FAILURE_EN", 1.0, 9))
        ground.wait_for("PARAM_VALUE")
        for params in ((nan,) * 4, (0.0,) * 4):
            assert ground.ask(inject, MOTOR, SLOW, 1, *params) == dialect.MAV_RESULT_ACCEPTED
        ground.wait_for("STATUSTEXT", lambda m: m.text == "fault injected: thrust 0.60")
        assert ground.ask(inject, MOTOR, OK, 0) == dialect.MAV_RESULT_ACCEPTED
        ground.wait_for("STATUSTEXT", lambda m: m.text == "fault removed: thrust")
        assert ground.ask(inject, AIRSPEED, DELAYED, 1) == dialect.MAV_RESULT_ACCEPTED
        ground.wait_for("STATUSTEXT", lambda m: m.text == "fault injected: airspeed delay")
        assert ground.ask(inject, MOTOR, SLOW, 2) == dialect.MAV_RESULT_UNSUPPORTED
        flight = up.land()
        ground.close()
    kinds = [command.kind for _, command in flight.commands]
    assert kinds == ["set-faults"] * 3 + ["end"]
    assert np.isfinite(flight.record["airspeed"]).all()
