"""Fly manoeuvres on the woven JSBSim aircraft and keep what a test pilot would bring home."""

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.disturbance.faults import fault_records, schedule
from ftc_jsb.errors import TrimError
from ftc_jsb.identify.manoeuvres import Manoeuvre
from ftc_jsb.recording.columns import ROW
from ftc_jsb.scenario.schema import AircraftChoice, Initial
from ftc_jsb.simulation.departure import FLYING, departed
from ftc_jsb.six_dof.plant import JsbsimPlant
from ftc_jsb.units import POUND_FORCE, STANDARD_GRAVITY
from ftc_jsb.vocabulary.channels import ENGINES

DT = 0.01  # [s]
STEPS = 2  # JSBSim frames a sample
LOWEST = 150.0  # [m], altitude at which a test is broken off
PATH_GAIN = 1.0  # [1/s], of the flight path hold


def fly_manoeuvre(aircraft: Aircraft, manoeuvre: Manoeuvre, area: float) -> npt.NDArray[Any] | None:
    """Recording of one manoeuvre, to where it leaves the test range; None where there is no trim.

    Args:
        aircraft: as loaded.
        manoeuvre: to be flown.
        area: reference area [m^2], for the limit of the lift coefficient.
    """
    test = aircraft.flight_test
    record = np.zeros(round(manoeuvre.duration / DT) + 1, ROW)
    record["time"] = np.arange(record.size) * DT
    schedule(fault_records(()), ENGINES, record)
    choice = AircraftChoice(name=str(aircraft.folder), fuel_fraction=manoeuvre.fuel_fraction)
    initial = Initial(airspeed=manoeuvre.airspeed, altitude=manoeuvre.altitude)
    plant = JsbsimPlant(choice, initial, DT, STEPS)
    try:
        plant.reset(record)
    except TrimError:
        return None
    idle, maximum = (
        plant.fdm.get_property_manager().get_node(f"ftc/deck/{level}-lbs").get_double_value
        for level in ("idle", "maximum")
    )
    for i in range(record.size):
        plant.truth(i)
        row = record[i]
        inside = test.airspeed[0] <= row["airspeed"] <= test.airspeed[1]
        inside = inside and row["altitude"] > LOWEST
        if departed(record, i) != FLYING or not inside or abs(row["flight_path_angle"]) > 1.2:
            return record[:i]
        fraction, load_factor, path, bank = manoeuvre.schedule(float(row["time"]))
        if math.isfinite(path):
            rate = PATH_GAIN * (path - row["flight_path_angle"])
            load_factor = math.cos(row["flight_path_angle"])
            load_factor += rate * row["airspeed"] / STANDARD_GRAVITY
        pressure_area = _pressure(row) * area
        most = test.lift_coefficient_max * pressure_area / (row["mass"] * STANDARD_GRAVITY)
        low, high = test.load_factor
        row["load_factor_cmd"] = min(max(load_factor, low, -0.5 * most), high, most)
        row["bank_angle_cmd"] = bank
        healthy = idle() + min(max(fraction, 0.0), 1.0) * (maximum() - idle())
        row["thrust_cmd"] = healthy * POUND_FORCE
        plant.step(i)
    return record


def _pressure(row: Any) -> float:
    from ftc_jsb.point_mass.atmosphere import standard_atmosphere

    density, _ = standard_atmosphere(float(row["altitude"]))
    return 0.5 * density * float(row["airspeed"]) ** 2
