"""The typed `aircraft.toml`: what the weaving, the trim and the sensors need to know of an aircraft."""

import tomllib
from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from ftc_jsb.errors import AircraftError
from ftc_jsb.resources import shipped
from ftc_jsb.scenario.messages import first_problem

PAPER_AIRCRAFT = "paper"  # the aircraft of the model `paper`

_Name = Annotated[str, Field(min_length=1, max_length=200)]
_Value = Annotated[float, Field(ge=-1e9, le=1e9)]


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Edit(_Strict):
    """One change of the aircraft's XML, refused if the element does not hold what is expected."""

    element: _Name  # path below the root, as in xml.etree
    expect: str  # the element's text in the installed file
    replace: str | None = None
    remove: bool = False


class Correction(_Strict):
    """A named repair of the stock flight control system, with its reason."""

    name: _Name
    reason: _Name | Annotated[str, Field(max_length=2000)]
    edit: tuple[Edit, ...]


class Positions(_Strict):
    """Properties of the control positions, in rad; throttle with 1 at military, 2 at full reheat."""

    throttle: _Name
    elevator: _Name
    aileron: _Name
    rudder: _Name
    flap: _Name


class FlightTest(_Strict):
    """The range that identification flies, and so the range in which the point mass is valid."""

    airspeed: tuple[_Value, _Value]  # m/s
    altitude: Annotated[tuple[_Value, ...], Field(min_length=1)]  # m
    fuel_fraction: Annotated[tuple[_Value, ...], Field(min_length=1)]
    load_factor: tuple[_Value, _Value]
    mach_breaks: tuple[_Value, ...] = ()  # Mach numbers at which flaps switch
    lift_coefficient_max: Annotated[float, Field(gt=0.0, le=10.0)]


class Aircraft(_Strict):
    """An aircraft folder: JSBSim model, set-up, corrections, control positions."""

    name: _Name
    title: _Name
    jsbsim_model: _Name
    fuel_tanks: tuple[Annotated[int, Field(ge=0, le=50)], ...]
    setup: dict[str, _Value]
    positions: Positions
    flight_test: FlightTest
    correction: tuple[Correction, ...] = ()
    folder: Path = Field(default=Path(), exclude=True)


def aircraft_folder(name: str) -> Path:
    """Folder of an aircraft: a bare name is a shipped one, `./name` or any other path a folder.

    Raises:
        AircraftError: there is no such folder.
    """
    plain = Path(name).name == name  # a bare name is a shipped aircraft, whatever lies around
    for candidate in (shipped("aircraft") / name,) if plain else (Path(name),):
        if any((candidate / file).is_file() for file in ("point_mass.toml", "aircraft.toml")):
            return candidate.resolve()
    known = ", ".join(aircraft_names())
    raise AircraftError(
        f"aircraft.name: no aircraft {name!r}; expected one of {known}, "
        "or the path of a folder (./mine) that holds point_mass.toml"
    )


def aircraft_names() -> list[str]:
    """Names of the shipped aircraft."""
    return sorted(path.parent.name for path in shipped("aircraft").glob("*/point_mass.toml"))


def load_aircraft(name: str) -> Aircraft:
    """Read `aircraft.toml` of a shipped aircraft, or of a user's folder.

    Raises:
        AircraftError: no such folder, no such file, or not what the file must hold.
    """
    path = aircraft_folder(name) / "aircraft.toml"
    if not path.is_file():
        raise AircraftError(f"{path}: not found; the jsbsim model needs it beside point_mass.toml")
    try:
        values = tomllib.loads(path.read_text(encoding="utf-8"))
        return Aircraft(**values).model_copy(update={"folder": path.parent})
    except (OSError, UnicodeDecodeError) as error:
        raise AircraftError(f"{path}: cannot be read: {error}") from None
    except tomllib.TOMLDecodeError as error:
        raise AircraftError(f"{path}: not TOML: {error}") from None
    except ValidationError as error:
        raise AircraftError(f"{path}: {first_problem(error, Aircraft)}") from None
