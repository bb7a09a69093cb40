"""The flights of a margin measurement: one perturbation each, on a fresh plant."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.margins.input_perturbation import Perturbation, PerturbedPlant
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.assembly import build_plant, point_mass_of
from ftc_jsb.simulation.fly import fly
from ftc_jsb.vocabulary.channels import Channel

Array = npt.NDArray[np.float64]


class PerturbedFlight(NamedTuple):
    """What one channel was commanded and given, and whether the flight came to its end."""

    commanded: Array
    given: Array
    complete: bool
    reason: str


def perturbed_flight(
    scenario: Scenario, channel: Channel, perturbation: Perturbation, seconds: float
) -> PerturbedFlight:
    """Fly with one command perturbed.

    Args:
        scenario: straight and level, see `condition.level_scenario`.
        channel: whose command is perturbed.
        perturbation: how.
        seconds: of flight.


    Raises:
        UserError: the aircraft cannot be had or trimmed.
        KeyboardInterrupt: the flight was interrupted, which says nothing of the loop.
    """
    flown = scenario.model_copy(update={"duration": seconds})
    model = point_mass_of(flown).record(flown.aircraft.fuel_fraction)
    plant = PerturbedPlant(build_plant(flown, model, 1.0 / flown.loop.rate), channel, perturbation)
    flight = fly(flown, plant=plant)
    rows: Any = flight.record[f"{channel}_cmd"]
    given = plant.given[: rows.size]
    outcome = flight.outcome
    if outcome.status == "interrupted":
        raise KeyboardInterrupt
    return PerturbedFlight(np.array(rows), given, outcome.status == "complete", outcome.reason)
