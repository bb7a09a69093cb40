"""Step responses of the closed inner loop, flown on the woven aircraft, and what they are judged by."""

import math
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.disturbance.faults import fault_records, schedule
from ftc_jsb.recording.columns import ROW
from ftc_jsb.scenario.schema import AircraftChoice, Initial
from ftc_jsb.six_dof.plant import JsbsimPlant
from ftc_jsb.six_dof.properties import write_checked
from ftc_jsb.units import POUND_FORCE
from ftc_jsb.vocabulary.channels import ENGINES

DT = 0.01  # [s]
STEPS = 2  # JSBSim frames a sample
START = 1.0  # [s] of steady flight before a step
MOST_STEP = 3.0  # load factor
BANK_STEP = math.radians(60.0)
STEEP = math.radians(70.0)
TURN_TIME = 8.0  # [s]
SETTLED = 3.0  # [s] after which a turn is steady
SHARE_OF_PULL = 0.8  # of what an aircraft can pull, where that is less than 3

# Commands at a time [s], given the row before it is flown: thrust [N] or nan to hold the trim's,
# load factor, bank [rad].
Commands = Callable[[float, Any], tuple[float, float, float]]


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
        commands: see `Commands`.
        seconds: of flight.
        numbers: properties of the inner loop to be set before it is engaged.
        stock: fly the stock flight control.

    Raises:
        TrimError, AircraftError: as the plant.
    """
    record = np.zeros(round(seconds / DT), ROW)
    record["time"] = np.arange(record.size) * DT
    schedule(fault_records(()), ENGINES, record)
    watched = np.zeros((record.size, 5))
    choice = AircraftChoice(
        name=str(aircraft.folder),
        fuel_fraction=fuel_fraction,
        flight_control="stock" if stock else "corrected",
    )
    plant = JsbsimPlant(choice, initial, DT, STEPS)
    plant.reset(record)
    for name, value in (numbers or {}).items():
        write_checked(plant.fdm, name, value)
    nodes = [
        plant.fdm.get_property_manager().get_node(name).get_double_value
        for name in (
            "ftc/load-factor/reference",
            "ftc/bank/reference",
            "ftc/deck/idle-lbs",
            "ftc/deck/military-lbs",
            "ftc/deck/maximum-lbs",
        )
    ]
    hold = 0.0
    for i in range(record.size):
        plant.truth(i)
        row = record[i]
        hold = float(row["thrust"]) if i == 0 else hold
        watched[i] = [read() for read in nodes]
        thrust, load_factor, bank = commands(float(row["time"]), row)
        row["thrust_cmd"] = thrust if math.isfinite(thrust) else hold
        row["load_factor_cmd"], row["bank_angle_cmd"] = load_factor, bank
        plant.step(i)
    return Flown(record, watched[:, 0], watched[:, 1], watched[:, 2:] * POUND_FORCE)


def load_factor_step(most: float) -> Commands:
    """1 to `most` at START, wings level."""

    def commands(time: float, row: Any) -> tuple[float, float, float]:
        return math.nan, (most if time >= START else 1.0), 0.0

    return commands


def bank_step(time: float, row: Any) -> tuple[float, float, float]:
    """0 to 60 deg at START, load factor keeping the height."""
    load_factor = 1.0 / math.cos(min(abs(float(row["bank_angle"])), 1.1))
    return math.nan, load_factor, BANK_STEP if time >= START else 0.0


def steep_turn(time: float, row: Any) -> tuple[float, float, float]:
    """A level turn at 70 deg of bank."""
    return math.nan, 1.0 / math.cos(STEEP), STEEP


def pull(lift_coefficient_max: float, area: float, row: Any) -> float:
    """Load factor of the step: 3, or 80 % of what the aircraft can pull at the flight condition."""
    from ftc_jsb.point_mass.atmosphere import standard_atmosphere
    from ftc_jsb.units import STANDARD_GRAVITY

    density, _ = standard_atmosphere(float(row["altitude"]))
    lift = 0.5 * density * float(row["airspeed"]) ** 2 * area * lift_coefficient_max
    return min(MOST_STEP, SHARE_OF_PULL * lift / (float(row["mass"]) * STANDARD_GRAVITY))


class Response(NamedTuple):
    """What a step response is judged by."""

    rise: float  # [s], 10 to 90 %
    overshoot: float  # of the step
    settling: float  # [s] until within 5 % for good
    error: float  # mean of the last second, of the step
    following: float  # RMS difference from the loop's own reference, of the step


def response(
    time: npt.NDArray[np.float64],
    value: npt.NDArray[np.float64],
    reference: npt.NDArray[np.float64],
    first: float,
    last: float,
) -> Response:
    """Judge a step from `first` to `last` at START."""
    share = (value - first) / (last - first)
    after = time >= START
    reached = [
        time[np.argmax(share > level)] if (share > level).any() else math.inf
        for level in (0.1, 0.9)
    ]
    outside = np.flatnonzero(np.abs(share - 1.0) > 0.05)
    settled = time[outside[-1]] + DT - START if outside.size else 0.0
    return Response(
        rise=float(reached[1] - reached[0]),
        overshoot=float(max(share.max() - 1.0, 0.0)),
        settling=float(settled),
        error=float(abs(share[-round(1.0 / DT) :].mean() - 1.0)),
        following=float(np.sqrt(np.mean(((value - reference)[after] / (last - first)) ** 2))),
    )
