"""Flights of the closed inner loop under stepped commands, with the loop's own references."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.scenario.schema import AircraftChoice, Initial
from ftc_jsb.six_dof.commanded_flight import DT, Commands, fly_commanded, trimmed_aircraft
from ftc_jsb.six_dof.properties import readers, write_checked
from ftc_jsb.units import POUND_FORCE

WATCHED = (
    "ftc/load-factor/reference",
    "ftc/bank/reference",
    "ftc/deck/idle-lbs",
    "ftc/deck/military-lbs",
    "ftc/deck/maximum-lbs",
)


class Flown(NamedTuple):
    """A step flight: its recording and the inner loop's own references, (samples,) each."""

    record: npt.NDArray[Any]
    load_factor_reference: npt.NDArray[np.float64]
    bank_reference: npt.NDArray[np.float64]
    levels: npt.NDArray[np.float64]  # (samples, 3): idle, military, maximum thrust [N]


def fly_commands(
    aircraft: Aircraft,
    initial: Initial,
    fuel_fraction: float,
    commands: Commands,
    seconds: float,
    numbers: Mapping[str, float] | None = None,
    stock: bool = False,
) -> Flown:
    """The engaged inner loop under `commands`.

    Args:
        aircraft: as loaded.
        initial: trimmed flight at the start.
        fuel_fraction: of internal fuel.
        commands: see `commanded_flight.Commands`.
        seconds: of flight.
        numbers: properties of the inner loop to be set before the first sample.
        stock: fly the stock flight control.

    Raises:
        TrimError, AircraftError: as the plant.
    """
    choice = AircraftChoice(
        name=str(aircraft.folder),
        fuel_fraction=fuel_fraction,
        flight_control="stock" if stock else "corrected",
    )
    trimmed = trimmed_aircraft(choice, initial, round(seconds / DT))
    for name, value in (numbers or {}).items():
        write_checked(trimmed.fdm, name, value)
    reads = readers(trimmed.fdm, WATCHED)
    watched = np.zeros((trimmed.record.size, len(WATCHED)))

    def watch(i: int) -> None:
        watched[i] = [read() for read in reads]

    record = fly_commanded(trimmed, commands, watch=watch)
    return Flown(record, watched[:, 0], watched[:, 1], watched[:, 2:] * POUND_FORCE)
