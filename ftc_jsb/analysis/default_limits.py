"""Limits that every flight has, from its aircraft and its references; a scenario's own stand in their place."""

import contextlib
import math

import numpy as np

from ftc_jsb.aircraft.point_mass_file import PointMass
from ftc_jsb.errors import AircraftError
from ftc_jsb.scenario.limits import Limits
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.assembly import point_mass_of

BANK_MARGIN = 25.0  # [deg] beyond the bank of the steepest turn that the references ask for
LEAST_BANK = 60.0  # [deg] that no flight is blamed for
LOAD_FACTOR_MARGIN = 0.5  # beyond what the loop may command: overshoot of the inner loop
ALPHA_MARGIN = 5.0  # [deg] beyond the angles that the aircraft was identified at
LIMITS: dict[str, tuple[float, float]] = {  # of any aircraft
    "altitude": (50.0, 20000.0),  # [m] above sea level
    "sideslip_deg": (-10.0, 10.0),
    "error_airspeed": (-15.0, 15.0),  # [m/s]
    "error_flight_path_deg": (-5.0, 5.0),
    "error_heading_deg": (-10.0, 10.0),
}


def flight_limits(scenario: Scenario) -> Limits:
    """[limits] of a scenario, defaults in place of those that it does not give.

    Of a recording whose aircraft is not there any more, those that need no aircraft.
    """
    found = dict(LIMITS)
    with contextlib.suppress(AircraftError):
        found |= aircraft_limits(scenario, point_mass_of(scenario))
    return Limits(**{**found, **scenario.limits.model_dump(exclude_none=True)})


def aircraft_limits(scenario: Scenario, aircraft: PointMass) -> dict[str, tuple[float, float]]:
    """Limits that follow from an aircraft, by key, in the keys' units.

    Args:
        scenario: its references say how far the aircraft has to bank.
        aircraft: what the loop counts on; its load factors and the range that it was identified in.
    """
    bank = max(LEAST_BANK, steepest_bank(scenario, aircraft) + BANK_MARGIN)
    load = aircraft.load_factor
    found = {
        "bank_deg": (-bank, bank),
        "load_factor": (load.minimum - LOAD_FACTOR_MARGIN, load.maximum + LOAD_FACTOR_MARGIN),
    }
    if aircraft.measured_drag is not None:
        low, high = (math.degrees(aircraft.measured_drag.alpha[k]) for k in (0, -1))
        found["alpha_deg"] = (low - ALPHA_MARGIN, high + ALPHA_MARGIN)
    return found


def steepest_bank(scenario: Scenario, aircraft: PointMass) -> float:
    """Bank [deg] of the steepest level turn between the breakpoints of the heading, at the fastest airspeed."""
    points = np.array(scenario.reference.heading_deg, dtype=float)
    if len(points) < 2:
        return 0.0
    fastest = max(value for _, value in scenario.reference.airspeed)
    turn = np.radians(np.abs(np.diff(points[:, 1]) / np.diff(points[:, 0]))).max()
    steepest = math.acos(1.0 / aircraft.load_factor.maximum)
    return math.degrees(min(math.atan(fastest * turn / aircraft.mass.gravity), steepest))
