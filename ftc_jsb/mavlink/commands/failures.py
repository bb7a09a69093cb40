"""MAV_CMD_INJECT_FAILURE: which faults of the scenario's kinds a failure of MAVLink's is."""

from collections.abc import Sequence
from typing import Any

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.recording.commands import SetFaults
from ftc_jsb.scenario.faults import Fault
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.admissible_faults import impossible
from ftc_jsb.vocabulary.channels import SURFACES

ALL = 0  # instance
SENSORS = {
    dialect.FAILURE_UNIT_SENSOR_GYRO: ("roll_rate", "pitch_rate", "yaw_rate"),
    dialect.FAILURE_UNIT_SENSOR_ACCEL: ("load_factor_x", "load_factor_y", "load_factor_z"),
    dialect.FAILURE_UNIT_SENSOR_MAG: ("yaw",),
    dialect.FAILURE_UNIT_SENSOR_BARO: ("altitude",),
    dialect.FAILURE_UNIT_SENSOR_GPS: ("north", "east"),
    dialect.FAILURE_UNIT_SENSOR_AIRSPEED: ("airspeed",),
}
OK, OFF, STUCK = dialect.FAILURE_TYPE_OK, dialect.FAILURE_TYPE_OFF, dialect.FAILURE_TYPE_STUCK
SLOW, WRONG = dialect.FAILURE_TYPE_SLOW, dialect.FAILURE_TYPE_WRONG
DELAYED = dialect.FAILURE_TYPE_DELAYED

LOSS = "loss-of-effectiveness"


def failure(
    scenario: Scenario,
    engines: int,
    unit: int,
    kind: int,
    instance: int,
    effectiveness: float,
    delay: float,
) -> SetFaults | None:
    """The command for a failure; None where the aircraft cannot have it.

    Args:
        scenario: what is flown.
        engines: of the aircraft.
        unit: FAILURE_UNIT.
        kind: FAILURE_TYPE.
        instance: from 1 on, of engines or of elevator, aileron, rudder; 0 for all.
        effectiveness: that a failure of the kind SLOW leaves.
        delay: of a sensor that is DELAYED [s].
    """
    every = instance == ALL
    makes: dict[int, dict[str, Any]]
    if unit == dialect.FAILURE_UNIT_SYSTEM_MOTOR:
        every = every or (engines == 1 and instance == 1)
        parts = _chosen([f"engine[{number}]" for number in range(engines)], instance)
        targets = ["thrust", *parts] if every else parts
        hit = ["thrust"] if every and kind == SLOW else parts
        makes = {
            SLOW: {"kind": LOSS, "effectiveness": effectiveness},
            OFF: {"kind": "flame-out"},
            STUCK: {"kind": "stuck"},
        }
    elif unit == dialect.FAILURE_UNIT_SYSTEM_SERVO:
        hit = targets = _chosen(SURFACES, instance)
        makes = {
            SLOW: {"kind": LOSS, "effectiveness": effectiveness},
            OFF: {"kind": LOSS, "effectiveness": 0.0},
            STUCK: {"kind": "stuck"},
            WRONG: {"kind": "hard-over", "direction": 1},
        }
    elif unit in SENSORS and instance in (ALL, 1):
        hit = targets = list(SENSORS[unit])
        makes = {
            OFF: {"kind": "dropout"},
            STUCK: {"kind": "freeze"},
            DELAYED: {"kind": "delay", "delay": delay},
        }
    else:
        return None
    if kind == OK and targets:
        return SetFaults(targets=tuple(targets))
    faults = [_fault(target, makes[kind]) for target in hit] if kind in makes else []
    if not faults or any(impossible(scenario, fault) for fault in faults):
        return None
    return SetFaults(targets=tuple(targets), faults=tuple(faults))


def _chosen(parts: Sequence[str], instance: int) -> list[str]:
    """All parts, or the one of an instance; none if there is none."""
    return list(parts) if instance == ALL else list(parts[instance - 1 : instance])


def _fault(target: str, numbers: dict[str, Any]) -> Fault:
    return Fault(target=target, start=0.0, **numbers)
