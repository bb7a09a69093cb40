"""A point mass that is wrong by known factors: what a loop counts on when its model is not the aircraft."""

from ftc_jsb.aircraft.knot_tables import Row, Table
from ftc_jsb.aircraft.point_mass_aerodynamics import Aerodynamics, MeasuredDrag
from ftc_jsb.aircraft.point_mass_file import PointMass
from ftc_jsb.aircraft.point_mass_thrust import Thrust
from ftc_jsb.scenario.model_error import ModelError


def wrong_model(aircraft: PointMass, error: ModelError) -> PointMass:
    """`aircraft` with mass, drag coefficients and thrust deck times the factors of `error`."""
    if error == ModelError():
        return aircraft
    mass = aircraft.mass.model_copy(
        update={
            "empty": aircraft.mass.empty * error.mass,
            "fuel_capacity": aircraft.mass.fuel_capacity * error.mass,
        }
    )
    measured = aircraft.measured_drag
    parts = {
        "mass": mass,
        "aerodynamics": _polar(aircraft.aerodynamics, error.drag),
        "measured_drag": None if measured is None else _measured(measured, error.drag),
        "thrust": _deck(aircraft.thrust, error.thrust),
    }
    return aircraft.model_copy(update=parts)


def _polar(polar: Aerodynamics, factor: float) -> Aerodynamics:
    table = polar.drag_table
    if table is not None:
        table = table.model_copy(update={"values": _times(table.values, factor)})
    return polar.model_copy(update={"drag": _times(polar.drag, factor), "drag_table": table})


def _measured(drag: MeasuredDrag, factor: float) -> MeasuredDrag:
    tables = {
        name: _times(getattr(drag, name), factor) for name in ("mach_alpha", "alpha_elevator")
    }
    rows = {name: _row(getattr(drag, name), factor) for name in ("pitch_rate", "sideslip")}
    numbers = {name: getattr(drag, name) * factor for name in ("flap", "sideslip_squared")}
    return drag.model_copy(update=tables | rows | numbers)


def _deck(deck: Thrust, factor: float) -> Thrust:
    tables = ("idle", "military", "maximum")
    return deck.model_copy(update={name: _times(getattr(deck, name), factor) for name in tables})


def _times(table: Table, factor: float) -> Table:
    return tuple(_row(row, factor) for row in table)


def _row(row: Row, factor: float) -> Row:
    return tuple(value * factor for value in row)
