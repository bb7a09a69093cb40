"""Which faults of the scenario's kinds a failure of MAV_CMD_INJECT_FAILURE is."""

from collections.abc import Sequence
from typing import Any, NamedTuple

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.recording.commands import SetFaults
from ftc_jsb.scenario.faults import Fault
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.admissible_faults import impossible
from ftc_jsb.vocabulary.channels import SURFACES

ALL = 0  # instance
SENSORS = {  # signals of each FAILURE_UNIT
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


class Failure(NamedTuple):
    """A failure as MAV_CMD_INJECT_FAILURE and the parameters of the vehicle have it."""

    unit: int  # FAILURE_UNIT
    kind: int  # FAILURE_TYPE
    instance: int  # from 1 on, of engines or of elevator, aileron, rudder; 0 for all
    effectiveness: float  # that a failure of the kind SLOW leaves
    delay: float  # [s] of a sensor that is DELAYED


class _Faults(NamedTuple):
    """What the failures of a unit are in a scenario."""

    targets: Sequence[str]  # whose earlier faults end
    faulty: Sequence[str]  # which of them get the fault
    kinds: dict[int, dict[str, Any]]  # by FAILURE_TYPE: fields of the fault


def faults_of_failure(scenario: Scenario, engines: int, failure: Failure) -> SetFaults | None:
    """The command for a failure; None where the aircraft cannot have it.

    Args:
        scenario: what is flown.
        engines: of the aircraft.
        failure: of which unit, and how.
    """
    possible = _of_unit(engines, failure)
    if possible is None:
        return None
    targets, faulty, kinds = possible
    if failure.kind == OK and targets:
        return SetFaults(targets=tuple(targets))
    if failure.kind not in kinds:
        return None
    faults = [_fault(target, kinds[failure.kind]) for target in faulty]
    if not faults or any(impossible(scenario, fault) for fault in faults):
        return None
    return SetFaults(targets=tuple(targets), faults=tuple(faults))


def _of_unit(engines: int, failure: Failure) -> _Faults | None:
    """What can fail of a unit; None of one that no aircraft here has."""
    if failure.unit == dialect.FAILURE_UNIT_SYSTEM_MOTOR:
        return _of_engines(engines, failure)
    if failure.unit == dialect.FAILURE_UNIT_SYSTEM_SERVO:
        return _of_surfaces(failure)
    if failure.unit in SENSORS and failure.instance in (ALL, 1):
        return _of_sensor(failure)
    return None


def _of_engines(engines: int, failure: Failure) -> _Faults:
    """All engines that lose effectiveness are one fault of thrust."""
    instance = failure.instance
    every = instance == ALL or (engines == 1 and instance == 1)
    parts = _chosen([f"engine[{number}]" for number in range(engines)], instance)
    return _Faults(
        targets=["thrust", *parts] if every else parts,
        faulty=["thrust"] if every and failure.kind == SLOW else parts,
        kinds={
            SLOW: {"kind": LOSS, "effectiveness": failure.effectiveness},
            OFF: {"kind": "flame-out"},
            STUCK: {"kind": "stuck"},
        },
    )


def _of_surfaces(failure: Failure) -> _Faults:
    surfaces = _chosen(SURFACES, failure.instance)
    return _Faults(
        targets=surfaces,
        faulty=surfaces,
        kinds={
            SLOW: {"kind": LOSS, "effectiveness": failure.effectiveness},
            OFF: {"kind": LOSS, "effectiveness": 0.0},
            STUCK: {"kind": "stuck"},
            WRONG: {"kind": "hard-over", "direction": 1},
        },
    )


def _of_sensor(failure: Failure) -> _Faults:
    signals = SENSORS[failure.unit]
    return _Faults(
        targets=signals,
        faulty=signals,
        kinds={
            OFF: {"kind": "dropout"},
            STUCK: {"kind": "freeze"},
            DELAYED: {"kind": "delay", "delay": failure.delay},
        },
    )


def _chosen(parts: Sequence[str], instance: int) -> list[str]:
    """All parts, or the one of an instance; none if there is none."""
    return list(parts) if instance == ALL else list(parts[instance - 1 : instance])


def _fault(target: str, fields: dict[str, Any]) -> Fault:
    return Fault(target=target, start=0.0, **fields)
