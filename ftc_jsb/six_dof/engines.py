"""Engines of a loaded JSBSim aircraft: how many, and the thrust that they deliver."""

from typing import Any

from ftc_jsb.errors import AircraftError
from ftc_jsb.units import POUND_FORCE


def engine_count(fdm: Any) -> int:
    """Number of engines.

    Raises:
        AircraftError: there is none.
    """
    count = int(fdm.get_propulsion().get_num_engines())
    if count == 0:
        raise AircraftError(f"{fdm.get_model_name()}: the aircraft has no engine")
    return count


def thrust_property(engine: int) -> str:
    """Property of an engine's thrust [lbs]."""
    return f"propulsion/engine[{engine}]/thrust-lbs"


def delivered_thrust(fdm: Any, engines: int) -> float:
    """Thrust of all engines together [N]."""
    return float(sum(fdm[thrust_property(engine)] for engine in range(engines)) * POUND_FORCE)
