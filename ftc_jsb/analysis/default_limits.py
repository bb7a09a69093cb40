"""Limits that every flight has, from its aircraft and its references; a scenario's own stand in their place."""

import math

import numpy as np

from ftc_jsb.aircraft.point_mass_file import PointMass
from ftc_jsb.scenario.limits import Limits
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.assembly import point_mass_of

BANK_MARGIN = 25.0  # [deg] beyond the bank of the steepest turn that the references ask for
LEAST_BANK = 60.0  # [deg] that no flight is blamed for
LOAD_FACTOR_MARGIN = 0.5  # beyond what the loop may command: overshoot of the inner loop
ALPHA_MARGIN = 5.0  # [deg] beyond the angles that the aircraft was identified at
SIDESLIP = 10.0  # [deg]
GROUND_CLEARANCE = 50.0  # [m] above sea level
CEILING = 20000.0  # [m]
ERROR_AIRSPEED = 15.0  # [m/s]
ERROR_PATH = 5.0  # [deg]
ERROR_HEADING = 10.0  # [deg]


def flight_limits(scenario: Scenario) -> Limits:
    """[limits] of a scenario, defaults in place of those that it does not give.

    Raises:
        AircraftError: the aircraft is not there.
    """
    given = scenario.limits.model_dump(exclude_none=True)
    return Limits(**{**default_limits(scenario, point_mass_of(scenario)), **given})


def default_limits(scenario: Scenario, aircraft: PointMass) -> dict[str, tuple[float, float]]:
    """Limits by key, in the keys' units.

    Args:
        scenario: its references say how far the aircraft has to bank.
        aircraft: what the loop counts on; its load factors and the range that it was identified in.
    """
    bank = max(LEAST_BANK, steepest_bank(scenario, aircraft) + BANK_MARGIN)
    load = aircraft.load_factor
    found = {
        "altitude": (GROUND_CLEARANCE, CEILING),
        "bank_deg": (-bank, bank),
        "load_factor": (load.minimum - LOAD_FACTOR_MARGIN, load.maximum + LOAD_FACTOR_MARGIN),
        "sideslip_deg": (-SIDESLIP, SIDESLIP),
        "error_airspeed": (-ERROR_AIRSPEED, ERROR_AIRSPEED),
        "error_flight_path_deg": (-ERROR_PATH, ERROR_PATH),
        "error_heading_deg": (-ERROR_HEADING, ERROR_HEADING),
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
