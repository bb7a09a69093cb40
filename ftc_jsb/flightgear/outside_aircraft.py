"""An aircraft that another program flies, as a plant: what its lines say, as truth in the recording."""

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.aircraft.point_mass_file import load_point_mass
from ftc_jsb.compiled import direct
from ftc_jsb.resources import aircraft_folder
from ftc_jsb.scenario.schema import AircraftChoice, Initial, Scenario
from ftc_jsb.six_dof.exchange.fields import FAULTS, LOAD_FACTORS, measured_fields
from ftc_jsb.six_dof.observation import (
    JSBSIM_STATE,
    POSITION_NAMES,
    PROPERTIES,
    observe,
    place_origin,
)
from ftc_jsb.units import FOOT
from ftc_jsb.vocabulary.channels import ENGINES

Numbers = tuple[float, ...]  # of a line, in the order of `measured_fields`
FLYING_NOBODY, FLYING_OUTER_LOOP, FLYING_INNER_LOOP = 0.0, 1.0, 2.0
_SLOWEST, _FASTEST = 50.0, 600.0  # [m/s], of [initial]


class LineFields:
    """Where in a line of an aircraft its fields stand."""

    def __init__(self, choice: AircraftChoice) -> None:
        """Args: [aircraft] of a scenario."""
        self.aircraft = load_aircraft(choice.name)
        self.engines = load_point_mass(aircraft_folder(choice.name)).thrust.engines
        fields = measured_fields(self.aircraft, self.engines)
        self.count = len(fields)
        self._place = {field.name: place for place, field in enumerate(fields)}

    def value(self, numbers: Numbers, name: str) -> float:
        """A field of a line by its name."""
        return numbers[self._place[name]]

    def slice(self, first: str, count: int) -> slice:
        """`count` fields from the one of a name on."""
        return slice(self._place[first], self._place[first] + count)


class OutsideAircraft:
    """A `Plant` that is flown elsewhere: `read` gives it the line of a sample, `truth` writes it down."""

    def __init__(self, fields: LineFields, origin: Numbers, initial: Initial) -> None:
        """Args: of the aircraft's lines; the line whose position is the origin; [initial] there."""
        self._fields, self._origin, self._initial = fields, origin, initial
        self._state = np.zeros(1, JSBSIM_STATE)
        self._raw = np.zeros(len(PROPERTIES) + len(POSITION_NAMES) + fields.engines)
        self._observed = fields.slice("vt-fps", self._raw.size)
        self._faults = fields.slice(FAULTS[0], len(FAULTS))
        self._line: Numbers = origin

    def reset(self, record: npt.NDArray[Any]) -> None:
        """Bind the recording; the tangent plane is where the aircraft was at the line of the origin."""
        self._record = record
        place = self._fields.slice("ecef-x-ft", 3)
        origin = [number * FOOT for number in self._origin[place]]
        place_origin(self._state[0], self._initial, origin)
        self._observe = direct(observe, self._raw, self._state, record, 0)

    def read(self, numbers: Numbers) -> None:
        """The line of the sample to come."""
        self._line = numbers

    def truth(self, i: int) -> None:
        """Write state and faults of the line to row `i`."""
        self._raw[:] = self._line[self._observed]
        weight = self._raw[PROPERTIES.index("inertia/weight-lbs")]
        for name, (_, sense) in LOAD_FACTORS.items():
            self._raw[PROPERTIES.index(name)] *= sense * weight
        self._observe(self._raw, self._state, self._record, i)
        row = self._record[i]
        for name, value in zip(FAULTS, self._line[self._faults], strict=True):
            row[name] = value
        working = [row[f"engine_{k}_effectiveness"] for k in range(self._fields.engines)]
        for k in range(self._fields.engines, ENGINES):
            row[f"engine_{k}_effectiveness"] = math.nan
        row["effectiveness_thrust"] = sum(working) / len(working)
        row["effectiveness_load_factor"] = row["effectiveness_bank_angle"] = 1.0

    def step(self, i: int) -> None:
        """Nothing: it flies by itself."""

    def close(self) -> None:
        """Nothing is held."""


def started_where_it_is(scenario: Scenario, fields: LineFields, numbers: Numbers) -> Scenario:
    """The scenario whose [initial] is what a line says; heading within half a turn of its reference.

    Args:
        scenario: as loaded.
        fields: of the lines of its aircraft.
        numbers: of a line.
    """
    import pymap3d

    x, y, z = (number * FOOT for number in numbers[fields.slice("ecef-x-ft", 3)])
    latitude, longitude, _ = pymap3d.ecef2geodetic(x, y, z)
    heading = math.degrees(fields.value(numbers, "psi-rad"))
    wanted = scenario.reference.heading_deg[0][1]
    heading += 360.0 * round((wanted - heading) / 360.0)
    airspeed = fields.value(numbers, "vt-fps") * FOOT
    initial = Initial(
        airspeed=min(max(airspeed, _SLOWEST), _FASTEST),
        altitude=min(max(fields.value(numbers, "h-sl-ft") * FOOT, 100.0), 18000.0),
        flight_path_deg=0.0,
        heading_deg=min(max(heading, -360.0), 360.0),
        latitude_deg=float(latitude),
        longitude_deg=float(longitude),
    )
    return scenario.model_copy(update={"initial": initial, "model": "flightgear"})
