"""How far a flown check case is outside what the published simulations span."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.six_dof.commanded_flight import DT, STEPS
from validation.check_cases.cases import Case
from validation.check_cases.flight import fly_case, inertial_rates
from validation.check_cases.published import QUANTITIES, TABLE

RATES = ("roll_rate", "pitch_rate", "yaw_rate")


class Compared(NamedTuple):
    """One quantity of a case, a value a second. SI, rad."""

    flown: npt.NDArray[np.float64]
    least: npt.NDArray[np.float64]  # of the published simulations
    most: npt.NDArray[np.float64]

    @property
    def outside(self) -> float:
        """The most that it is outside the published spread; 0 where it stays inside."""
        beyond = np.maximum(self.least - self.flown, self.flown - self.most)
        return float(max(np.nanmax(beyond), 0.0))

    @property
    def spread(self) -> float:
        """The most that the published simulations differ, but for the start, where some leave out the wind."""
        return float(np.nanmax((self.most - self.least)[1:]))


def compare(case: Case, frames: int = STEPS) -> dict[str, Compared]:
    """A case, flown; rates are those of inertial space, and only of what tumbles: a sphere's play no part.

    Args:
        case: to be flown.
        frames: of JSBSim in a hundredth of a second.
    """
    table = np.genfromtxt(TABLE, delimiter=",", names=True)
    published = table[table["case"] == case.number]
    record = fly_case(case, frames)
    rates = inertial_rates(record, case.planet)
    each = round(1.0 / DT)
    found = {}
    for name in QUANTITIES:
        values: Any = rates[:, RATES.index(name)] if name in RATES else record[name]
        if name not in RATES or "brick" in case.title:
            ends = (published[f"{name}_least"], published[f"{name}_most"])
            found[name] = Compared(np.asarray(values[::each]), *ends)
    return found
