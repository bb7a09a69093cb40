"""The aircraft's limits as lines of the V-n and the Mach-altitude panel."""

import contextlib
import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.aircraft.dynamic_pressure import density_at
from ftc_jsb.aircraft.point_mass_file import PointMass
from ftc_jsb.control.limits import NEGATIVE_LIFT
from ftc_jsb.errors import AircraftError
from ftc_jsb.point_mass.atmosphere import standard_atmosphere
from ftc_jsb.recording.flight import Flight
from ftc_jsb.report.flight_groups import Flights
from ftc_jsb.report.titles import aircraft_title
from ftc_jsb.simulation.assembly import point_mass_of
from ftc_jsb.vocabulary.quantities import QUANTITIES

Array = npt.NDArray[np.float64]

SEA_LEVEL = standard_atmosphere(0.0)[0]  # [kg/m^3]
SAMPLES = 60  # of a curve
BEYOND = 1.15  # of the fastest that was flown, to which lines go where nothing ends them


class Outline(NamedTuple):
    """A line of a panel that bounds what an aircraft can fly."""

    chart: str
    name: str
    owners: list[int]  # flights, by their place on the page
    x: list[float | None]  # None: the line is interrupted
    y: list[float | None]


def equivalent_airspeed(flight: Flight) -> Array:
    """(rows,): airspeed [m/s] of the same dynamic pressure at sea level."""
    record = flight.record
    return np.asarray(
        record["airspeed"] * np.sqrt(_density(flight, record["altitude"]) / SEA_LEVEL)
    )


def outlines(flights: Flights) -> list[Outline]:
    """Limits of every aircraft that these flights are of; none of one that is gone."""
    found: dict[str, Outline] = {}
    for number, flight in enumerate(flights.values()):
        aircraft = _aircraft(flight)
        if aircraft is None:
            continue
        for outline in (_load_factors(flight, aircraft), _altitudes(flight, aircraft)):
            # one line for flights of one aircraft, however long each of them was
            at = f"{outline.chart} {outline.name} {flight.scenario.aircraft.fuel_fraction}"
            found.setdefault(at, outline).owners.append(number)
    return list(found.values())


def _aircraft(flight: Flight) -> PointMass | None:
    with contextlib.suppress(AircraftError):
        return point_mass_of(flight.scenario)
    return None


def _density(flight: Flight, altitude: Array) -> Array:
    """Of the air [kg/m^3] that a flight's model flies in; the paper's is the same everywhere."""
    if flight.scenario.model == "paper":
        aircraft = _aircraft(flight)
        if aircraft is not None and aircraft.atmosphere is not None:
            return np.full(altitude.shape, aircraft.atmosphere.density)
    return density_at(altitude)


def _name(flight: Flight) -> str:
    paper = flight.scenario.model == "paper"
    return "paper's aircraft" if paper else aircraft_title(flight.scenario)


def _load_factors(flight: Flight, aircraft: PointMass) -> Outline:
    """Load factors that the loop may command, and those of the greatest lift below them."""
    load, record = aircraft.load_factor, flight.record
    # n = CL_max 1/2 rho_0 V_e^2 S / W
    lift = 0.5 * load.lift_coefficient_max * SEA_LEVEL * aircraft.aerodynamics.area
    per_square = lift / (float(record["mass"][0]) * aircraft.mass.gravity)
    fastest = float(np.nanmax(equivalent_airspeed(flight))) * BEYOND
    if aircraft.valid is not None:
        density, sound = standard_atmosphere(float(np.nanmin(record["altitude"])))
        fastest = aircraft.valid.mach[1] * sound * math.sqrt(density / SEA_LEVEL)
    below = NEGATIVE_LIFT * per_square
    upper, lower = math.sqrt(load.maximum / per_square), math.sqrt(max(-load.minimum, 0.0) / below)
    rising, falling = np.linspace(upper, 0.0, SAMPLES), np.linspace(0.0, lower, SAMPLES)
    x = [fastest, *rising, *falling, fastest]
    y = [load.maximum, *(per_square * rising**2), *(-below * falling**2), load.minimum]
    if aircraft.valid is not None:
        x, y = [*x, fastest], [*y, load.maximum]
    return Outline("vn", _name(flight), [], [float(v) for v in x], [float(v) for v in y])


def _altitudes(flight: Flight, aircraft: PointMass) -> Outline:
    """Slowest Mach number of level flight over altitude, and the range that the model was fitted in."""
    record, load = flight.record, aircraft.load_factor
    highest = float(np.nanmax(record["altitude"])) * BEYOND
    x: list[float | None] = []
    y: list[float | None] = []
    if aircraft.valid is not None:
        (slow, fast), (low, high) = aircraft.valid.mach, aircraft.valid.altitude
        highest = max(highest, high)
        x, y = [slow, fast, fast, slow, slow, None], [low, low, high, high, low, None]
    altitude = np.linspace(max(float(np.nanmin(record["altitude"])) * 0.5, 0.0), highest, SAMPLES)
    weight = float(record["mass"][0]) * aircraft.mass.gravity
    pressure = weight / (load.lift_coefficient_max * aircraft.aerodynamics.area)
    slowest = np.sqrt(2.0 * pressure / _density(flight, altitude)) / _sound_speed(
        aircraft, altitude
    )
    shown = QUANTITIES["altitude"].shown
    return Outline(
        "mach_altitude",
        _name(flight),
        [],
        [*x, *slowest.tolist()],
        [*(None if v is None else shown(v) for v in y), *shown(altitude).tolist()],
    )


def _sound_speed(aircraft: PointMass, altitude: Array) -> Array:
    if aircraft.atmosphere is not None:
        return np.full(altitude.shape, aircraft.atmosphere.sound_speed)
    return np.array([standard_atmosphere(height)[1] for height in altitude])


def as_data(found: list[Outline]) -> list[dict[str, Any]]:
    """Outlines as the page's script reads them, to four digits."""
    return [
        {
            **outline._asdict(),
            "x": [None if v is None else float(f"{v:.4g}") for v in outline.x],
            "y": [None if v is None else float(f"{v:.4g}") for v in outline.y],
        }
        for outline in found
    ]
