"""Fly manoeuvres on the woven JSBSim aircraft and keep what a test pilot would bring home."""

import math
from typing import Any

import numpy.typing as npt

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.aircraft.dynamic_pressure import greatest_lift
from ftc_jsb.errors import TrimError
from ftc_jsb.identify.manoeuvres import Manoeuvre
from ftc_jsb.scenario.schema import AircraftChoice, Initial
from ftc_jsb.simulation.departure import FLYING, departed
from ftc_jsb.six_dof.commanded_flight import DT, fly_commanded, trimmed_aircraft
from ftc_jsb.six_dof.properties import readers
from ftc_jsb.units import POUND_FORCE, STANDARD_GRAVITY

LOWEST = 150.0  # [m], altitude at which a test is broken off
STEEPEST = 1.2  # [rad], flight path angle at which it is
PATH_GAIN = 1.0  # [1/s], of the flight path hold
DECK = ("ftc/deck/idle-lbs", "ftc/deck/maximum-lbs")


def fly_manoeuvre(aircraft: Aircraft, manoeuvre: Manoeuvre, area: float) -> npt.NDArray[Any] | None:
    """Recording of one manoeuvre, to where it leaves the test range; None where there is no trim.

    Args:
        aircraft: as loaded.
        manoeuvre: to be flown.
        area: reference area [m^2], for the limit of the lift coefficient.

    Raises:
        AircraftError: it cannot be woven, loaded or flown.
    """
    test = aircraft.flight_test
    choice = AircraftChoice(name=str(aircraft.folder), fuel_fraction=manoeuvre.fuel_fraction)
    initial = Initial(airspeed=manoeuvre.airspeed, altitude=manoeuvre.altitude)
    try:
        trimmed = trimmed_aircraft(
            choice,
            initial,
            round(manoeuvre.duration / DT) + 1,
            wind=manoeuvre.wind,
            seed=manoeuvre.seed,
        )
    except TrimError:
        return None
    idle, maximum = readers(trimmed.fdm, DECK)

    def commands(time: float, row: Any) -> tuple[float, float, float]:
        fraction, load_factor, path, bank = manoeuvre.schedule(time)
        if math.isfinite(path):
            load_factor = _path_hold(row, path)
        lift = greatest_lift(row, area, test.lift_coefficient_max)
        most = lift / (row["mass"] * STANDARD_GRAVITY)
        low, high = test.load_factor
        healthy = idle() + min(max(fraction, 0.0), 1.0) * (maximum() - idle())
        return healthy * POUND_FORCE, min(max(load_factor, low, -0.5 * most), high, most), bank

    def outside(record: npt.NDArray[Any], i: int) -> bool:
        row = record[i]
        return bool(
            departed(record, i) != FLYING
            or not test.airspeed[0] <= row["airspeed"] <= test.airspeed[1]
            or not row["altitude"] > LOWEST
            or abs(row["flight_path_angle"]) > STEEPEST
        )

    return fly_commanded(trimmed, commands, stop=outside)


def _path_hold(row: Any, path: float) -> float:
    """Load factor that takes a recorded row's flight path angle to `path` [rad]."""
    rate = PATH_GAIN * (path - row["flight_path_angle"])
    load_factor = math.cos(row["flight_path_angle"])
    return float(load_factor + rate * row["airspeed"] / STANDARD_GRAVITY)
