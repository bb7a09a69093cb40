"""A healthy JSBSim aircraft flown from its trim by commands to the inner loop, without an outer loop."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.disturbance.faults import fault_records, schedule
from ftc_jsb.recording.columns import ROW
from ftc_jsb.scenario.schema import AircraftChoice, Initial
from ftc_jsb.scenario.wind import Wind
from ftc_jsb.six_dof.plant import JsbsimPlant
from ftc_jsb.vocabulary.channels import ENGINES

DT = 0.01  # [s] a sample
STEPS = 2  # JSBSim frames a sample

# Commands at a time [s], given the row before it is flown: thrust [N] or nan to hold the trim's,
# load factor, bank [rad].
Commands = Callable[[float, Any], tuple[float, float, float]]


class TrimmedAircraft(NamedTuple):
    """An aircraft at its trim with the inner loop engaged, and the recording that it will write."""

    plant: JsbsimPlant
    record: npt.NDArray[Any]  # (samples,) of ROW

    @property
    def fdm(self) -> Any:
        """JSBSim's instance, for properties that the recording does not have."""
        return self.plant.fdm


def trimmed_aircraft(
    choice: AircraftChoice,
    initial: Initial,
    samples: int,
    *,
    wind: Wind | None = None,
    seed: int = 0,
) -> TrimmedAircraft:
    """Trim and engage.

    Args:
        choice: [aircraft] of a scenario.
        initial: condition to trim at.
        samples: of the flight to come, DT each.
        wind: [wind] of a scenario; default: still air.
        seed: of the wind.

    Raises:
        AircraftError, TrimError: as the plant.
    """
    record = healthy_recording(samples)
    plant = JsbsimPlant(choice, initial, DT, STEPS, wind=wind, seed=seed)
    plant.reset(record)
    return TrimmedAircraft(plant, record)


def healthy_recording(samples: int) -> npt.NDArray[Any]:
    """(samples,) of ROW: time [s] and the absence of faults, the rest zero."""
    record = np.zeros(samples, ROW)
    record["time"] = np.arange(samples) * DT
    schedule(fault_records(()), ENGINES, record)
    return record


def fly_commanded(
    aircraft: TrimmedAircraft,
    commands: Commands,
    *,
    stop: Callable[[npt.NDArray[Any], int], bool] | None = None,
    watch: Callable[[int], Any] | None = None,
) -> npt.NDArray[Any]:
    """The recording, to its end or to where the flight is stopped.

    Args:
        aircraft: at its trim.
        commands: see `Commands`.
        stop: whether to end the flight before the recording's row i is flown.
        watch: called with each row's number before it is flown, to read JSBSim's properties.

    Raises:
        AircraftError: JSBSim raised, or says that it is over.
    """
    plant, record = aircraft
    hold = math.nan
    for i in range(record.size):
        plant.truth(i)
        if stop is not None and stop(record, i):
            return record[:i]
        row = record[i]
        hold = float(row["thrust"]) if i == 0 else hold
        if watch is not None:
            watch(i)
        thrust, load_factor, bank = commands(float(row["time"]), row)
        row["thrust_cmd"] = thrust if math.isfinite(thrust) else hold
        row["load_factor_cmd"], row["bank_angle_cmd"] = load_factor, bank
        plant.step(i)
    return record
