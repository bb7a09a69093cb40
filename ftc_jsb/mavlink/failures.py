"""MAV_CMD_INJECT_FAILURE: which fault of the scenario's kinds a failure of MAVLink's is."""

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.scenario.schema import Fault
from ftc_jsb.simulation.commands import Heal, Inject

ALL = 0  # instance


def failure(unit: int, kind: int, instance: int, effectiveness: float) -> Inject | Heal | None:
    """The command for a failure; None where the aircraft cannot have it.

    Args:
        unit: FAILURE_UNIT.
        kind: FAILURE_TYPE.
        instance: number of the engine from 1 on, or 0 for all.
        effectiveness: that is left by a failure of the kind SLOW.
    """
    if unit != dialect.FAILURE_UNIT_SYSTEM_MOTOR or instance not in (ALL, 1):
        return None
    if kind == dialect.FAILURE_TYPE_OK:
        return Heal(target="thrust")
    left = {dialect.FAILURE_TYPE_SLOW: effectiveness, dialect.FAILURE_TYPE_OFF: 0.0}.get(kind)
    if left is None:
        return None
    return Inject(fault=Fault(target="thrust", effectiveness=left, start=0.0))
