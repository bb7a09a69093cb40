"""What JSBSim's model of an aircraft says of it before any flight: reference area, masses, engines."""

from typing import NamedTuple

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.six_dof.engines import engine_count
from ftc_jsb.six_dof.fuel_tanks import contents_property, tank_capacity
from ftc_jsb.six_dof.loading import initialise, load
from ftc_jsb.six_dof.weaving.woven_aircraft import woven_aircraft
from ftc_jsb.units import FOOT, POUND_MASS

DT = 0.01  # [s]: nothing is flown, JSBSim wants one


class DataSheet(NamedTuple):
    """Numbers of an airframe."""

    area: float  # [m^2], reference area
    empty_mass: float  # [kg], without internal fuel
    fuel_capacity: float  # [kg], internal
    engines: int


def data_sheet(aircraft: Aircraft) -> DataSheet:
    """Reference area, masses and engines of the installed model.

    Args:
        aircraft: as loaded.

    Raises:
        AircraftError: it cannot be woven or loaded, or a fuel tank is empty as shipped.
    """
    fdm = load(aircraft, woven_aircraft(aircraft, True), DT)
    capacity = 0.0
    for tank in aircraft.fuel_tanks:
        capacity += tank_capacity(aircraft, fdm, tank)
        fdm[contents_property(tank)] = 0.0
    initialise(fdm, aircraft.name)
    return DataSheet(
        area=float(fdm["metrics/Sw-sqft"]) * FOOT**2,
        empty_mass=fdm["inertia/weight-lbs"] * POUND_MASS,
        fuel_capacity=capacity * POUND_MASS,
        engines=engine_count(fdm),
    )
