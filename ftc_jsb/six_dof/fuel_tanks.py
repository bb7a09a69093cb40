"""Internal fuel tanks of a loaded JSBSim aircraft: what they hold when full, and filling them."""

from typing import Any

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.errors import AircraftError
from ftc_jsb.six_dof.properties import node


def contents_property(tank: int) -> str:
    """Property of the fuel in a tank [lbs]."""
    return f"propulsion/tank[{tank}]/contents-lbs"


def tank_capacity(aircraft: Aircraft, fdm: Any, tank: int) -> float:
    """Fuel in a full tank [lbs], from what it holds as shipped.

    Raises:
        AircraftError: there is no such tank, or it is empty.
    """
    fraction = node(fdm, f"propulsion/tank[{tank}]/pct-full").get_double_value()
    contents = node(fdm, contents_property(tank)).get_double_value()
    if fraction <= 0.0:
        raise AircraftError(f"aircraft {aircraft.name!r}: fuel tank {tank} is empty as shipped")
    return float(100.0 * contents / fraction)


def fill_tanks(aircraft: Aircraft, fdm: Any, fuel_fraction: float) -> None:
    """Fill each tank of `aircraft.toml` to a fraction.

    Raises:
        AircraftError: there is no such tank, or it is empty as shipped.
    """
    for tank in aircraft.fuel_tanks:
        fdm[contents_property(tank)] = fuel_fraction * tank_capacity(aircraft, fdm, tank)
