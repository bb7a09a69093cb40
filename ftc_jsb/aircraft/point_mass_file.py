"""The typed `point_mass.toml`: Table 1 of the paper, or an aircraft identified from flights."""

import json
import tomllib
from pathlib import Path
from typing import Annotated, Any, Self

import numpy as np
import numpy.typing as npt
from pydantic import Field, ValidationError, model_validator

from ftc_jsb.errors import AircraftError
from ftc_jsb.point_mass.model import (
    ALPHA_KNOTS,
    ALPHA_TERMS,
    ALTITUDE_KNOTS,
    DRAG_TERMS,
    ELEVATOR_KNOTS,
    LIFT_KNOTS,
    MACH_KNOTS,
    MODEL,
)
from ftc_jsb.typed_file import Section, first_problem
from ftc_jsb.vocabulary.channels import ENGINES

_Number = Annotated[float, Field(ge=-1e9, le=1e9)]
_Positive = Annotated[float, Field(gt=0.0, le=1e9)]
_Row = tuple[_Number, ...]
_Table = tuple[_Row, ...]


def _increasing(name: str, knots: _Row, most: int) -> None:
    if not 1 <= len(knots) <= most or list(knots) != sorted(set(knots)):
        raise ValueError(f"{name}: expected 1 to {most} increasing numbers")


def _shaped(name: str, table: _Table, rows: int, columns: int) -> None:
    if len(table) != rows or any(len(row) != columns for row in table):
        raise ValueError(f"{name}: expected {rows} rows of {columns} numbers")


class Mass(Section):
    """Mass and the gravity that the equations use."""

    empty: _Positive  # kg, without internal fuel
    fuel_capacity: Annotated[float, Field(ge=0.0, le=1e6)] = 0.0  # kg, internal
    gravity: Annotated[float, Field(ge=9.0, le=10.5)] = 9.80665  # m/s2


class LoadFactor(Section):
    """Limits of the load factor command."""

    minimum: Annotated[float, Field(ge=-10.0, le=0.9)]
    maximum: Annotated[float, Field(ge=1.1, le=20.0)]
    lift_coefficient_max: Annotated[float, Field(gt=0.0, le=10.0)]


class DragTable(Section):
    """Drag coefficient to be added to the parabola, over Mach and equally spaced C_L."""

    lift_coefficient: _Row
    values: _Table

    @model_validator(mode="after")
    def _equally_spaced(self) -> Self:
        name = "aerodynamics.drag_table.lift_coefficient"
        _increasing(name, self.lift_coefficient, LIFT_KNOTS)
        steps = np.diff(self.lift_coefficient)
        if len(steps) == 0 or np.ptp(steps) > 1e-6:
            raise ValueError(f"{name}: expected equal steps")
        return self


class Aerodynamics(Section):
    """Drag polar and angle of attack: a polynomial in C_L for each Mach knot."""

    area: _Positive  # m2
    mach: _Row
    drag: _Table  # C_D = sum c_j C_L^j, j = 0..2
    alpha: _Table  # rad, sum a_j C_L^j, j = 0..3
    drag_table: DragTable | None = None

    @model_validator(mode="after")
    def _shapes(self) -> Self:
        rows = len(self.mach)
        _increasing("aerodynamics.mach", self.mach, MACH_KNOTS)
        _shaped("aerodynamics.drag", self.drag, rows, DRAG_TERMS)
        _shaped("aerodynamics.alpha", self.alpha, rows, ALPHA_TERMS)
        if self.drag_table is not None:
            columns = len(self.drag_table.lift_coefficient)
            _shaped("aerodynamics.drag_table.values", self.drag_table.values, rows, columns)
        return self


class MeasuredDrag(Section):
    """Drag coefficient from measured angles, surfaces and pitch rate, for the estimator."""

    mach: _Row
    alpha: _Row  # rad
    elevator: _Row  # rad
    mach_alpha: _Table
    alpha_elevator: _Table
    pitch_rate: _Row  # m/rad, for each alpha; times q / V
    flap: _Number  # 1/rad
    sideslip: _Row = ()  # 1/rad, for each alpha; times its magnitude
    sideslip_squared: _Number  # 1/rad2

    @model_validator(mode="after")
    def _shapes(self) -> Self:
        _increasing("measured_drag.mach", self.mach, MACH_KNOTS)
        _increasing("measured_drag.alpha", self.alpha, ALPHA_KNOTS)
        _increasing("measured_drag.elevator", self.elevator, ELEVATOR_KNOTS)
        rows, columns = len(self.alpha), len(self.elevator)
        _shaped("measured_drag.mach_alpha", self.mach_alpha, len(self.mach), rows)
        _shaped("measured_drag.alpha_elevator", self.alpha_elevator, rows, columns)
        _shaped("measured_drag.pitch_rate", (self.pitch_rate,), 1, rows)
        if self.sideslip:
            _shaped("measured_drag.sideslip", (self.sideslip,), 1, rows)
        return self


class Thrust(Section):
    """Thrust deck [N] of all engines, healthy, over Mach and altitude; and the spool."""

    engines: Annotated[int, Field(ge=1, le=ENGINES)] = 1
    mach: _Row
    altitude: _Row  # m
    idle: _Table
    military: _Table
    maximum: _Table
    spool_up: tuple[_Number, _Number, _Number] = (0.0, 0.0, 0.0)  # see `thrust.spool_rate`
    spool_down: tuple[_Number, _Number, _Number] = (0.0, 0.0, 0.0)

    @model_validator(mode="after")
    def _shapes(self) -> Self:
        _increasing("thrust.mach", self.mach, MACH_KNOTS)
        _increasing("thrust.altitude", self.altitude, ALTITUDE_KNOTS)
        for name in ("idle", "military", "maximum"):
            _shaped(f"thrust.{name}", getattr(self, name), len(self.mach), len(self.altitude))
        return self


class Response(Section):
    """Closed inner loop as second-order lags; without it commands act at once."""

    load_factor_frequency: Annotated[float, Field(ge=0.0, le=100.0)] = 0.0  # rad/s
    load_factor_damping: Annotated[float, Field(gt=0.0, le=5.0)] = 1.0
    bank_frequency: Annotated[float, Field(ge=0.0, le=100.0)] = 0.0  # rad/s
    bank_damping: Annotated[float, Field(gt=0.0, le=5.0)] = 1.0
    bank_rate_max: Annotated[float, Field(ge=0.0, le=20.0)] = 0.0  # rad/s; 0 = no limit
    bank_acceleration_max: Annotated[float, Field(ge=0.0, le=1e3)] = 0.0  # rad/s2; 0 = no limit


class Atmosphere(Section):
    """Constant density as in Table 1, in place of the standard atmosphere."""

    density: _Positive  # kg/m3
    sound_speed: _Positive  # m/s, only for the Mach number that is recorded


class Validity(Section):
    """The range that was fitted, [low, high]."""

    mach: tuple[_Number, _Number]
    lift_coefficient: tuple[_Number, _Number]
    altitude: tuple[_Number, _Number]  # m


class PointMass(Section):
    """A whole `point_mass.toml`."""

    title: str
    mass: Mass
    load_factor: LoadFactor
    aerodynamics: Aerodynamics
    thrust: Thrust
    measured_drag: MeasuredDrag | None = None
    response: Response = Response()
    atmosphere: Atmosphere | None = None
    valid: Validity | None = None  # outside, the loop says so
    identification: dict[str, Any] = Field(
        default_factory=dict
    )  # how, when and how well it was fitted

    def initial_mass(self, fuel_fraction: float) -> float:
        """Mass [kg] with a fraction of the internal fuel."""
        return self.mass.empty + fuel_fraction * self.mass.fuel_capacity

    def record(self, fuel_fraction: float) -> npt.NDArray[Any]:
        """The same numbers as a (1,) MODEL array for the kernels."""
        model = np.zeros(1, MODEL)
        m = model[0]
        m["gravity"] = self.mass.gravity
        m["mass"] = self.initial_mass(fuel_fraction)
        m["area"] = self.aerodynamics.area
        m["load_factor_min"] = self.load_factor.minimum
        m["load_factor_max"] = self.load_factor.maximum
        m["lift_coefficient_max"] = self.load_factor.lift_coefficient_max
        if self.atmosphere is not None:
            m["constant_density"] = self.atmosphere.density
            m["constant_sound_speed"] = self.atmosphere.sound_speed
        knots = len(self.aerodynamics.mach)
        m["mach_count"] = knots
        m["mach"][:knots] = self.aerodynamics.mach
        m["drag"][:knots] = self.aerodynamics.drag
        m["alpha"][:knots] = self.aerodynamics.alpha
        table = self.aerodynamics.drag_table
        if table is not None:
            columns = len(table.lift_coefficient)
            m["lift_count"] = columns
            m["lift_first"] = table.lift_coefficient[0]
            m["lift_spacing"] = table.lift_coefficient[1] - table.lift_coefficient[0]
            m["drag_table"][:knots, :columns] = table.values
        if self.measured_drag is not None:
            _fill_measured_drag(m, self.measured_drag)
        if self.valid is not None:
            m["valid_mach"] = self.valid.mach
            m["valid_lift"] = self.valid.lift_coefficient
            m["valid_altitude"] = self.valid.altitude
        rows, columns = len(self.thrust.mach), len(self.thrust.altitude)
        m["deck_mach_count"], m["deck_altitude_count"] = rows, columns
        m["deck_mach"][:rows] = self.thrust.mach
        m["deck_altitude"][:columns] = self.thrust.altitude
        m["thrust_idle"][:rows, :columns] = self.thrust.idle
        m["thrust_military"][:rows, :columns] = self.thrust.military
        m["thrust_maximum"][:rows, :columns] = self.thrust.maximum
        m["spool_up"], m["spool_down"] = self.thrust.spool_up, self.thrust.spool_down
        response = self.response
        m["response_frequency"] = (response.load_factor_frequency, response.bank_frequency)
        m["response_damping"] = (response.load_factor_damping, response.bank_damping)
        m["bank_rate_max"] = response.bank_rate_max
        m["bank_acceleration_max"] = response.bank_acceleration_max
        return model


def _fill_measured_drag(m: Any, drag: MeasuredDrag) -> None:
    rows, columns, depth = len(drag.mach), len(drag.alpha), len(drag.elevator)
    m["measured_mach_count"] = rows
    m["measured_alpha_count"] = columns
    m["measured_elevator_count"] = depth
    m["measured_mach"][:rows] = drag.mach
    m["measured_alpha"][:columns] = drag.alpha
    m["measured_elevator"][:depth] = drag.elevator
    m["measured_mach_alpha"][:rows, :columns] = drag.mach_alpha
    m["measured_alpha_elevator"][:columns, :depth] = drag.alpha_elevator
    m["measured_pitch_rate"][:columns] = drag.pitch_rate
    m["measured_flap"] = drag.flap
    m["measured_sideslip"][: len(drag.sideslip)] = drag.sideslip
    m["measured_sideslip_squared"] = drag.sideslip_squared


def load_point_mass(folder: Path) -> PointMass:
    """Read `point_mass.toml` of an aircraft folder.

    Raises:
        AircraftError: not found, not TOML, or not what the file must hold.
    """
    path = folder / "point_mass.toml"
    try:
        values = json.dumps(tomllib.loads(path.read_text(encoding="utf-8")), default=str)
        return PointMass.model_validate_json(values, strict=True)
    except (OSError, UnicodeDecodeError) as error:
        raise AircraftError(f"{path}: cannot be read: {error}") from None
    except tomllib.TOMLDecodeError as error:
        raise AircraftError(f"{path}: not TOML: {error}") from None
    except ValidationError as error:
        raise AircraftError(f"{path}: {first_problem(error, PointMass)}") from None
