"""A fitted point mass as the contents of `point_mass.toml`."""

import datetime
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from pydantic import ValidationError

import ftc_jsb
from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.aircraft.point_mass_file import PointMass
from ftc_jsb.errors import AircraftError
from ftc_jsb.identify.angles_drag import AnglesDrag
from ftc_jsb.identify.fuel_consumption import Consumption, consumption_residual
from ftc_jsb.identify.held_out import (
    drag_residuals,
    lift_residual,
    side_force_residual,
    thrust_residual,
)
from ftc_jsb.identify.inner_loop_lag import Lag
from ftc_jsb.identify.measured_lift import MeasuredLift
from ftc_jsb.identify.polar import Polar
from ftc_jsb.identify.regression import Array
from ftc_jsb.identify.samples import samples
from ftc_jsb.identify.side_force import SideForce
from ftc_jsb.identify.thrust_deck import Deck
from ftc_jsb.six_dof.data_sheet import DataSheet
from ftc_jsb.typed_file import first_problem
from ftc_jsb.units import STANDARD_GRAVITY


class FlownTests(NamedTuple):
    """Recordings of the test flights."""

    fitted: list[npt.NDArray[Any]]
    fitted_in_gusts: list[npt.NDArray[Any]]
    held_out: list[npt.NDArray[Any]]
    held_out_in_gusts: list[npt.NDArray[Any]]
    not_flown: int  # for want of a trim, or at once out of range


class FittedModel(NamedTuple):
    """Every part of the point mass that was fitted."""

    polar: Polar
    alpha: Array  # [rad], (mach, powers of C_L)
    angles: AnglesDrag
    lift: MeasuredLift
    side_force: SideForce
    deck: Deck
    spool_up: Array  # (3,) coefficients of `thrust.spool_rate`
    spool_down: Array
    consumption: Consumption
    load_factor: Lag
    bank: Lag


def contents(
    aircraft: Aircraft, sheet: DataSheet, tests: FlownTests, model: FittedModel
) -> dict[str, Any]:
    """The contents of `point_mass.toml`, as `PointMass` reads it.

    Args:
        aircraft: that was flown.
        sheet: its masses, area and engines.
        tests: flights, fitted to and held out.
        model: as fitted.
    """
    polar, flight_test = model.polar, aircraft.flight_test
    return {
        "title": f"{aircraft.title}, identified from JSBSim flights",
        "mass": {
            "empty": round(sheet.empty_mass, 3),
            "fuel_capacity": round(sheet.fuel_capacity, 3),
            "gravity": STANDARD_GRAVITY,
        },
        "load_factor": {
            "minimum": flight_test.load_factor[0],
            "maximum": flight_test.load_factor[1],
            "lift_coefficient_max": flight_test.lift_coefficient_max,
        },
        "aerodynamics": _aerodynamics(sheet.area, polar, model.alpha),
        "measured_drag": _measured_drag(model.angles),
        "measured_lift": _measured_lift(model.lift),
        "side_force": _side_force(model.side_force),
        "thrust": _thrust(sheet.engines, model),
        "fuel_flow": _fuel_flow(model.consumption),
        "response": _response(model.load_factor, model.bank),
        "valid": {
            "mach": _range(polar.mach),
            "lift_coefficient": _range(polar.lift),
            "altitude": _range(np.concatenate([record["altitude"] for record in tests.fitted])),
        },
        "identification": _identification(aircraft, sheet.area, tests, model),
    }


def _aerodynamics(area: float, polar: Polar, alpha: Array) -> dict[str, Any]:
    return {
        "area": area,
        "mach": _rounded(polar.mach, 6),
        "drag": _rounded(polar.parabola, 6),
        "alpha": _rounded(alpha, 6),
        "drag_table": {
            "lift_coefficient": _rounded(polar.lift, 6),
            "values": _rounded(polar.table, 6),
        },
    }


def _measured_drag(angles: AnglesDrag) -> dict[str, Any]:
    return {
        "mach": _rounded(angles.mach, 6),
        "alpha": _rounded(angles.alpha, 9),
        "elevator": _rounded(angles.elevator, 9),
        "mach_alpha": _rounded(angles.mach_alpha, 6),
        "alpha_elevator": _rounded(angles.alpha_elevator, 6),
        "pitch_rate": _rounded(angles.pitch_rate, 5),
        "flap": round(angles.flap, 6),
        "sideslip": _rounded(angles.sideslip, 6),
        "sideslip_squared": round(angles.sideslip_squared, 5),
    }


def _measured_lift(lift: MeasuredLift) -> dict[str, Any]:
    return {
        "mach_alpha": _rounded(lift.mach_alpha, 5),
        "alpha_elevator": _rounded(lift.alpha_elevator, 5),
        "pitch_rate": _rounded(lift.pitch_rate, 4),
        "path_rate": round(lift.path_rate, 4),
        "flap": round(lift.flap, 5),
    }


def _side_force(side: SideForce) -> dict[str, Any]:
    return {
        "sideslip_mach": _rounded(side.sideslip_mach, 5),
        "sideslip_alpha": _rounded(side.sideslip_alpha, 5),
        "sideslip_squared": round(side.sideslip_squared, 4),
        "roll_rate": _rounded(side.roll_rate, 4),
        "yaw_rate": _rounded(side.yaw_rate, 4),
        "aileron": round(side.aileron, 6),
        "rudder": round(side.rudder, 6),
    }


def _thrust(engines: int, model: FittedModel) -> dict[str, Any]:
    deck = model.deck
    return {
        "engines": engines,
        "mach": _rounded(deck.mach, 6),
        "altitude": _rounded(deck.altitude, 3),
        "idle": _rounded(deck.idle, 1),
        "military": _rounded(deck.military, 1),
        "maximum": _rounded(deck.maximum, 1),
        "spool_up": _rounded(model.spool_up, 4),
        "spool_down": _rounded(model.spool_down, 4),
    }


def _fuel_flow(consumption: Consumption) -> dict[str, Any]:
    return {
        "dry": round(consumption.dry, 9),
        "part_power": round(consumption.part_power, 4),
        "reheat": round(consumption.reheat, 9),
        "idle": round(consumption.idle, 5),
        "rise_dry": round(consumption.rise_dry, 5),
        "rise_reheat": round(consumption.rise_reheat, 5),
        "fall": round(consumption.fall, 5),
    }


def _response(load_factor: Lag, bank: Lag) -> dict[str, Any]:
    return {
        "load_factor_frequency": round(load_factor.frequency, 3),
        "load_factor_damping": round(load_factor.damping, 3),
        "bank_frequency": round(bank.frequency, 3),
        "bank_damping": round(bank.damping, 3),
        "bank_rate_max": round(bank.rate_max, 3),
        "bank_acceleration_max": round(bank.acceleration_max, 2),
    }


def _identification(
    aircraft: Aircraft, area: float, tests: FlownTests, model: FittedModel
) -> dict[str, Any]:
    """How, when and how well it was fitted."""
    import jsbsim

    drag = drag_residuals(tests.held_out, area, model.polar, model.angles)
    gusty = drag_residuals(tests.held_out_in_gusts, area, model.polar, model.angles)
    everything = [*tests.held_out, *tests.held_out_in_gusts]
    slip = side_force_residual(everything, area, model.side_force)
    thrust = thrust_residual(tests.held_out, model.deck, model.spool_up, model.spool_down)
    alpha = samples(tests.fitted, area).alpha
    return {
        "date": datetime.datetime.now(datetime.UTC).date().isoformat(),
        "command": f"ftc-jsb identify {aircraft.name}",
        "jsbsim_model": aircraft.jsbsim_model,
        "jsbsim": jsbsim.__version__,
        "ftc_jsb": ftc_jsb.__version__,
        "flights": len(tests.fitted) + len(tests.fitted_in_gusts),
        "flights_in_gusts": len(tests.fitted_in_gusts),
        "flights_not_flown": tests.not_flown,
        "flights_held_out": len(everything),
        "flights_held_out_in_gusts": len(tests.held_out_in_gusts),
        "held_out_beyond_mach_range_percent": round(100.0 * drag.beyond, 2),
        "alpha_range_deg": _range(np.degrees(alpha)),
        "residual_drag_polar_percent": _rms_percent(drag.polar),
        "residual_drag_polar_without_sideslip_percent": _rms_percent(drag.polar_without_sideslip),
        "residual_drag_angles_percent": _rms_percent(drag.angles),
        "residual_drag_polar_in_gusts_percent": _rms_percent(gusty.polar),
        "residual_drag_angles_in_gusts_percent": _rms_percent(gusty.angles),
        "residual_lift_coefficient": _rms(lift_residual(tests.held_out, area, model.lift)),
        "residual_lift_coefficient_in_gusts": _rms(
            lift_residual(tests.held_out_in_gusts, area, model.lift)
        ),
        "residual_sideslip_by_side_force_deg": _rms(np.degrees(slip)),
        "residual_thrust_percent_of_maximum": _rms_percent(thrust),
        "residual_fuel_flow_percent": _rms_percent(
            consumption_residual(tests.held_out, model.consumption)
        ),
        "residual_load_factor_response": round(model.load_factor.residual, 4),
        "residual_bank_response_deg": round(float(np.degrees(model.bank.residual)), 3),
        "residuals": "RMS on held-out flights, drag and thrust relative",
    }


def write_point_mass(path: Path, contents: dict[str, Any]) -> None:
    """Write `point_mass.toml`, having seen that it is valid.

    Raises:
        AircraftError: the fit has not what the file must hold.
    """
    import tomli_w

    try:
        PointMass(**contents)
    except ValidationError as error:
        raise AircraftError(f"identification: {first_problem(error, PointMass)}") from None
    header = (
        f"# Made by `{contents['identification']['command']}`; how and how well it was fitted is\n"
        "# under [identification]. docs/aircraft.md explains the method. SI, rad.\n\n"
    )
    path.write_text(header + tomli_w.dumps(contents), encoding="utf-8")


def _rounded(values: Array, digits: int) -> Any:
    return np.round(np.asarray(values, dtype=float), digits).tolist()


def _range(values: Array) -> list[float]:
    return [round(float(values.min()), 3), round(float(values.max()), 3)]


def _rms(error: Array) -> float:
    return round(float(np.sqrt(np.mean(error**2))), 5)


def _rms_percent(error: Array) -> float:
    return round(100.0 * float(np.sqrt(np.mean(error**2))), 3)
