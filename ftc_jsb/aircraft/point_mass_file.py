"""The typed `point_mass.toml`: Table 1 of the paper, or an aircraft identified from flights."""

import json
from functools import lru_cache
from pathlib import Path
from typing import Annotated, Any, Self

import numpy.typing as npt
from pydantic import Field, ValidationError, model_validator

from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.aircraft.knot_tables import Number, Positive
from ftc_jsb.aircraft.point_mass_aerodynamics import (
    Aerodynamics,
    MeasuredDrag,
    MeasuredLift,
    SideForce,
)
from ftc_jsb.aircraft.point_mass_record import model_record
from ftc_jsb.aircraft.point_mass_thrust import Thrust
from ftc_jsb.errors import AircraftError
from ftc_jsb.toml_file import TomlError, read_toml
from ftc_jsb.typed_file import Section, every_problem


class Mass(Section):
    """Mass and the gravity that the equations use."""

    empty: Positive  # kg, without internal fuel
    fuel_capacity: Annotated[float, Field(ge=0.0, le=1e6)] = 0.0  # kg, internal
    gravity: Annotated[float, Field(ge=9.0, le=10.5)] = 9.80665  # m/s2


class FuelFlow(Section):
    """What the engines burn; without it the mass stays. See `point_mass.fuel`."""

    dry: Annotated[float, Field(ge=0.0, le=1e-3)]  # kg/(N s), at military thrust and 15 deg C
    part_power: Annotated[float, Field(ge=0.0, le=10.0)]  # more of it, times (1 - N)^2
    reheat: Annotated[float, Field(ge=0.0, le=1e-3)]  # kg/(N s)
    idle: Annotated[float, Field(ge=1e-6, le=100.0)]  # kg/s, the least
    rise_dry: Annotated[float, Field(ge=1e-6, le=1e6)]  # kg/s2, the fastest change of the flow
    rise_reheat: Annotated[float, Field(ge=1e-6, le=1e6)]  # kg/s2
    fall: Annotated[float, Field(ge=1e-6, le=1e6)]  # kg/s2

    @property
    def coefficients(self) -> tuple[float, float, float, float]:
        """As `fuel.settled_fuel_flow` takes them."""
        return self.dry, self.part_power, self.reheat, self.idle

    @property
    def rates(self) -> tuple[float, float, float]:
        """As `fuel.burn_fuel` takes them."""
        return self.rise_dry, self.rise_reheat, self.fall


class LoadFactor(Section):
    """Limits of the load factor command."""

    minimum: Annotated[float, Field(ge=-10.0, le=0.9)]
    maximum: Annotated[float, Field(ge=1.1, le=20.0)]
    lift_coefficient_max: Annotated[float, Field(ge=1e-6, le=10.0)]


class InnerLoopResponse(Section):
    """Closed inner loop as second-order lags; without it commands act at once."""

    load_factor_frequency: Annotated[float, Field(ge=0.0, le=100.0)] = 0.0  # rad/s
    load_factor_damping: Annotated[float, Field(ge=1e-6, le=5.0)] = 1.0
    bank_frequency: Annotated[float, Field(ge=0.0, le=100.0)] = 0.0  # rad/s
    bank_damping: Annotated[float, Field(ge=1e-6, le=5.0)] = 1.0
    bank_rate_max: Annotated[float, Field(ge=0.0, le=20.0)] = 0.0  # rad/s; 0 = no limit
    bank_acceleration_max: Annotated[float, Field(ge=0.0, le=1e3)] = 0.0  # rad/s2; 0 = no limit

    @property
    def frequencies(self) -> tuple[float, float]:
        """Of load factor and bank [rad/s]."""
        return self.load_factor_frequency, self.bank_frequency

    @property
    def dampings(self) -> tuple[float, float]:
        """Of load factor and bank."""
        return self.load_factor_damping, self.bank_damping


class Atmosphere(Section):
    """Constant density as in Table 1, in place of the standard atmosphere."""

    density: Positive  # kg/m3
    sound_speed: Positive  # m/s, only for the Mach number that is recorded


class Validity(Section):
    """The range that was fitted, [low, high]."""

    mach: tuple[Number, Number]
    lift_coefficient: tuple[Number, Number]
    altitude: tuple[Number, Number]  # m


class PointMass(Section):
    """A whole `point_mass.toml`."""

    title: str
    mass: Mass
    load_factor: LoadFactor
    aerodynamics: Aerodynamics
    thrust: Thrust
    fuel_flow: FuelFlow | None = None
    measured_drag: MeasuredDrag | None = None
    measured_lift: MeasuredLift | None = None
    side_force: SideForce | None = None
    response: InnerLoopResponse = InnerLoopResponse()
    atmosphere: Atmosphere | None = None
    valid: Validity | None = None  # outside, the loop says so
    # How, when and how well it was fitted.
    identification: dict[str, Any] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _knots(self) -> Self:
        for name, part in (("measured_lift", self.measured_lift), ("side_force", self.side_force)):
            if part is not None:
                if self.measured_drag is None:
                    raise ValueError(f"{name}: expected [measured_drag], whose knots it has")
                part.check_knots(self.measured_drag)
        return self

    def initial_mass(self, fuel_fraction: float) -> float:
        """Mass [kg] with a fraction of the internal fuel."""
        return self.mass.empty + fuel_fraction * self.mass.fuel_capacity

    def record(self, fuel_fraction: float) -> npt.NDArray[Any]:
        """The same numbers as a (1,) MODEL array for the kernels."""
        return model_record(self, self.initial_mass(fuel_fraction))


def load_point_mass(folder: Path) -> PointMass:
    """Read `point_mass.toml` of an aircraft folder.

    Raises:
        AircraftError: not found, not TOML, not what the file must hold, or identified from another
            JSBSim model than the folder's `aircraft.toml` names.
    """
    path = folder / "point_mass.toml"
    try:
        stamp = path.stat()
    except OSError as error:
        raise AircraftError(f"{path}: cannot be read: {error}") from None
    return _read(path, (stamp.st_mtime_ns, stamp.st_size, stamp.st_ino))


@lru_cache(maxsize=16)  # a flight asks several times, and reading takes 40 ms
def _read(path: Path, stamp: tuple[int, ...]) -> PointMass:
    """The file as it was at `stamp`; what has changed since has another stamp."""
    try:
        values = json.dumps(read_toml(path), default=str)
        point_mass = PointMass.model_validate_json(values, strict=True)
    except TomlError as error:
        raise AircraftError(f"{path}: {error}") from None
    except ValidationError as error:
        raise AircraftError(f"{path}: {every_problem(error, PointMass)}") from None
    _check_whose(path, point_mass)
    return point_mass


def _check_whose(path: Path, point_mass: PointMass) -> None:
    identified = point_mass.identification.get("jsbsim_model")
    if identified is None or not (path.parent / "aircraft.toml").is_file():
        return
    flown = load_aircraft(str(path.parent)).jsbsim_model
    if identified != flown:
        raise AircraftError(
            f"{path}: the point mass of {identified!r}, not of {flown!r}, which aircraft.toml names; "
            "make its own by `ftc-jsb identify`"
        )
