"""The limits of a scenario, and where a flight broke them."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.analysis.tracking import tracking_errors
from ftc_jsb.scenario.limits import Limits
from ftc_jsb.vocabulary.quantities import QUANTITIES

Array = npt.NDArray[np.float64]
PLAIN = ("airspeed", "altitude", "load_factor", "mach")  # limited as they are recorded
ANGLES = ("bank_angle", "flight_path_angle", "alpha", "sideslip")  # limited in degrees


class BrokenLimit(NamedTuple):
    """The first time a variable left its range, and how far it went."""

    name: str  # key of [limits]
    time: float  # [s], of the first sample outside
    value: float  # the worst, in the key's unit
    limit: float  # the bound that it passed


def limited_variables(record: npt.NDArray[Any]) -> dict[str, Array]:
    """Every variable that can be limited, in the unit of its key in [limits]."""
    angles = [QUANTITIES[name] for name in ANGLES]
    return {
        **{name: record[name] for name in PLAIN},
        **{angle.key: angle.shown(record[angle.name]) for angle in angles},
        **tracking_errors(record),
    }


def broken_limits(record: npt.NDArray[Any], limits: Limits) -> list[BrokenLimit]:
    """Limits that a flight broke, the earliest first; a variable that is not recorded breaks none."""
    broken = []
    variables = limited_variables(record)
    for name in type(limits).model_fields:
        bounds = getattr(limits, name)
        if bounds is None:
            continue
        values = variables[name]
        for bound, beyond in zip(bounds, (bounds[0] - values, values - bounds[1]), strict=True):
            outside = np.flatnonzero(beyond > 0.0)
            if outside.size:
                worst = int(np.nanargmax(beyond))
                time = float(record["time"][outside[0]])
                broken.append(BrokenLimit(name, time, float(values[worst]), float(bound)))
    return sorted(broken, key=lambda limit: limit.time)
