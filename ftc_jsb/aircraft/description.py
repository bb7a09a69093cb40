"""The typed `aircraft.toml`: what the weaving, the trim and the sensors need to know of an aircraft."""

from functools import lru_cache
from pathlib import Path
from typing import Annotated, Literal, Self

from pydantic import Field, ValidationError, model_validator

from ftc_jsb.aircraft.airplane_class import AirplaneClass
from ftc_jsb.errors import AircraftError
from ftc_jsb.resources import aircraft_folder
from ftc_jsb.toml_file import TomlError, read_toml
from ftc_jsb.typed_file import Section, every_problem

_Name = Annotated[str, Field(min_length=1, max_length=200)]
_Value = Annotated[float, Field(ge=-1e9, le=1e9)]


class Edit(Section):
    """One change of the aircraft's XML, refused if the element does not hold what is expected."""

    file: str = Field("", max_length=200)  # engine or system it is in; empty = the aircraft's own
    element: _Name  # path below the root, as in xml.etree
    expect: str  # the element's text in the installed file
    replace: str | None = None
    remove: bool = False


class Correction(Section):
    """A named repair of the stock flight control system or engine, with its reason."""

    name: _Name
    reason: _Name | Annotated[str, Field(max_length=2000)]
    edit: tuple[Edit, ...]


class Throttle(Section):
    """What the inner loop writes for each engine, `[k]` added: where JSBSim reads it the same frame."""

    property: _Name
    military: Annotated[
        float, Field(ge=1e-6, le=10.0)
    ]  # its value there; twice that is full reheat


class Positions(Section):
    """Properties of the control positions; throttle with 1 at military, 2 at full reheat."""

    throttle: _Name
    elevator: _Name
    aileron: _Name
    rudder: _Name
    flap: _Name


class Surface(Section):
    """A surface position as the aerodynamics read it: what a fault of that surface changes."""

    property: _Name
    unit: Literal["rad", "norm"]
    travel: tuple[_Value, _Value]


class Surfaces(Section):
    """Every position property through which a surface acts on the aerodynamics."""

    elevator: Annotated[tuple[Surface, ...], Field(min_length=1)]
    aileron: Annotated[tuple[Surface, ...], Field(min_length=1)]
    rudder: Annotated[tuple[Surface, ...], Field(min_length=1)]


class FlightTest(Section):
    """The range that identification flies, and so the range in which the point mass is valid."""

    airspeed: tuple[_Value, _Value]  # m/s
    altitude: Annotated[tuple[_Value, ...], Field(min_length=1)]  # m
    fuel_fraction: Annotated[tuple[_Value, ...], Field(min_length=1)]
    load_factor: tuple[_Value, _Value]
    mach_breaks: tuple[_Value, ...] = ()  # Mach numbers at which flaps switch
    lift_coefficient_max: Annotated[float, Field(ge=1e-6, le=10.0)]
    # m/s at sea level; above, the tests keep to its dynamic pressure. Default: the lowest airspeed.
    slowest: Annotated[float, Field(ge=1e-3, le=1e3)] | None = None

    @model_validator(mode="after")
    def _ranges(self) -> Self:
        low, high = self.airspeed
        if not 0.0 < low < high:
            raise ValueError("flight_test.airspeed: expected two increasing speeds above 0")
        if list(self.altitude) != sorted(set(self.altitude)):
            raise ValueError("flight_test.altitude: expected increasing heights")
        if not all(0.0 <= fuel <= 1.0 for fuel in self.fuel_fraction):
            raise ValueError("flight_test.fuel_fraction: expected numbers from 0 to 1")
        if not self.load_factor[0] < 1.0 < self.load_factor[1]:
            raise ValueError("flight_test.load_factor: expected one below and one above 1")
        return self


class InnerLoop(Section):
    """Where the inner loop is designed and judged [m/s]; empty: as the test range has it."""

    design_airspeeds: tuple[_Value, ...] = ()
    step_airspeeds: tuple[_Value, ...] = ()


class Aircraft(Section):
    """An aircraft folder: JSBSim model, set-up, corrections, control positions."""

    name: _Name
    title: _Name
    jsbsim_model: _Name
    fuel_tanks: tuple[Annotated[int, Field(ge=0, le=50)], ...]
    setup: dict[str, _Value]
    throttle: Throttle
    positions: Positions
    surfaces: Surfaces
    flight_test: FlightTest
    # MIL-F-8785C: I light, II medium, III heavy, IV fighter. Default: by mass and load factor.
    airplane_class: AirplaneClass | None = None
    inner_loop: InnerLoop = InnerLoop()
    correction: tuple[Correction, ...] = ()
    folder: Path = Field(default=Path(), exclude=True)


def load_aircraft(name: str) -> Aircraft:
    """Read `aircraft.toml` of a shipped aircraft, or of a user's folder.

    Raises:
        AircraftError: no such folder, no such file, or not what the file must hold.
    """
    path = aircraft_folder(name) / "aircraft.toml"
    if not path.is_file():
        raise AircraftError(f"{path}: not found; the jsbsim model needs it beside point_mass.toml")
    stamp = path.stat()
    return _read(path, (stamp.st_mtime_ns, stamp.st_size, stamp.st_ino))


@lru_cache(maxsize=16)
def _read(path: Path, stamp: tuple[int, ...]) -> Aircraft:
    """The file as it was at `stamp`; what has changed since has another stamp."""
    try:
        return Aircraft(**read_toml(path)).model_copy(update={"folder": path.parent})
    except TomlError as error:
        raise AircraftError(f"{path}: {error}") from None
    except ValidationError as error:
        raise AircraftError(f"{path}: {every_problem(error, Aircraft)}") from None
