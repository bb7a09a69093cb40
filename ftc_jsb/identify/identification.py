"""`identify`: from virtual flight tests to a `point_mass.toml` with ranges and residuals."""

import datetime
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

import ftc_jsb
from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.aircraft.point_mass_file import PointMass
from ftc_jsb.errors import AircraftError
from ftc_jsb.identify import manoeuvres
from ftc_jsb.identify.aerodynamics import (
    between,
    fit_alpha,
    fit_angles_drag,
    fit_polar,
    relative_residual,
    sample,
)
from ftc_jsb.identify.engine import Deck, fit_deck, fit_spool
from ftc_jsb.identify.flight_test import DT, fly_manoeuvre
from ftc_jsb.identify.regression import Array
from ftc_jsb.identify.response import fit_lag
from ftc_jsb.point_mass.thrust import spool_rate
from ftc_jsb.six_dof.properties import engine_count
from ftc_jsb.six_dof.trim import load
from ftc_jsb.six_dof.weaving import woven_aircraft
from ftc_jsb.units import FOOT, POUND_MASS

Progress = Callable[[str], None]
SHORTEST = 100  # samples of a test flight that is worth keeping


def identify(aircraft: Aircraft, progress: Progress) -> dict[str, Any]:
    """Fly the tests, fit, and measure the fit on flights that it has not seen.

    Args:
        aircraft: as loaded.
        progress: told what is being done, a line at a time.

    Returns:
        The contents of `point_mass.toml`, as `PointMass` reads it.

    Raises:
        AircraftError: the aircraft cannot be woven, trimmed or flown.
    """
    airframe = _airframe(aircraft)
    area = airframe["area"]
    fitted = _fly(aircraft, area, manoeuvres.training, progress)
    unseen = _fly(aircraft, area, manoeuvres.held_out, progress)
    progress(f"fitting {sum(map(len, fitted)) * DT:.0f} s of flight")
    data, check = sample(fitted, area), sample(unseen, area)
    flown = len(check.mach)
    breaks = aircraft.flight_test.mach_breaks
    angles = fit_angles_drag(data, breaks)
    polar = fit_polar(data._replace(drag=data.drag - angles.of_sideslip(data)), breaks)
    check = between(check, polar.mach)  # where the loop does not call the model extrapolated
    alpha = fit_alpha(data, polar.mach)
    deck = fit_deck(fitted)
    spool_up, spool_down = fit_spool(fitted, deck)
    load_factor = fit_lag(fitted, "load_factor", DT)
    bank = fit_lag(fitted, "bank_angle", DT, limited=True)
    straight_error = relative_residual(polar.predict(check), check)
    polar_error = relative_residual(polar.predict(check) + angles.of_sideslip(check), check)
    angles_error = relative_residual(angles.predict(check), check)
    thrust_error = _thrust_residual(unseen, deck, spool_up, spool_down)
    return {
        "title": f"{aircraft.title}, identified from JSBSim flights",
        "mass": {
            "empty": airframe["empty"],
            "fuel_capacity": airframe["fuel_capacity"],
            "gravity": 9.80665,
        },
        "load_factor": {
            "minimum": aircraft.flight_test.load_factor[0],
            "maximum": aircraft.flight_test.load_factor[1],
            "lift_coefficient_max": aircraft.flight_test.lift_coefficient_max,
        },
        "aerodynamics": {
            "area": area,
            "mach": _rounded(polar.mach, 6),
            "drag": _rounded(polar.parabola, 6),
            "alpha": _rounded(alpha, 6),
            "drag_table": {
                "lift_coefficient": _rounded(polar.lift, 6),
                "values": _rounded(polar.table, 6),
            },
        },
        "measured_drag": {
            "mach": _rounded(angles.mach, 6),
            "alpha": _rounded(angles.alpha, 9),
            "elevator": _rounded(angles.elevator, 9),
            "mach_alpha": _rounded(angles.mach_alpha, 6),
            "alpha_elevator": _rounded(angles.alpha_elevator, 6),
            "pitch_rate": _rounded(angles.pitch_rate, 5),
            "flap": round(angles.flap, 6),
            "sideslip": _rounded(angles.sideslip, 6),
            "sideslip_squared": round(angles.sideslip_squared, 5),
        },
        "thrust": {
            "engines": airframe["engines"],
            "mach": _rounded(deck.mach, 6),
            "altitude": _rounded(deck.altitude, 3),
            "idle": _rounded(deck.idle, 1),
            "military": _rounded(deck.military, 1),
            "maximum": _rounded(deck.maximum, 1),
            "spool_up": _rounded(spool_up, 4),
            "spool_down": _rounded(spool_down, 4),
        },
        "response": {
            "load_factor_frequency": round(load_factor.frequency, 3),
            "load_factor_damping": round(load_factor.damping, 3),
            "bank_frequency": round(bank.frequency, 3),
            "bank_damping": round(bank.damping, 3),
            "bank_rate_max": round(bank.rate_max, 3),
            "bank_acceleration_max": round(bank.acceleration_max, 2),
        },
        "valid": {
            "mach": _range(polar.mach),
            "lift_coefficient": _range(polar.lift),
            "altitude": _range(np.concatenate([record["altitude"] for record in fitted])),
        },
        "identification": {
            "date": datetime.datetime.now(datetime.UTC).date().isoformat(),
            "command": f"ftc-jsb identify {aircraft.name}",
            "jsbsim": airframe["jsbsim"],
            "ftc_jsb": ftc_jsb.__version__,
            "flights": len(fitted),
            "flights_held_out": len(unseen),
            "held_out_beyond_mach_range_percent": round(100.0 * (1.0 - len(check.mach) / flown), 2),
            "alpha_range_deg": _range(np.degrees(data.alpha)),
            "residual_drag_polar_percent": _percent(polar_error),
            "residual_drag_polar_without_sideslip_percent": _percent(straight_error),
            "residual_drag_angles_percent": _percent(angles_error),
            "residual_thrust_percent_of_maximum": _percent(thrust_error),
            "residual_load_factor_response": round(load_factor.residual, 4),
            "residual_bank_response_deg": round(float(np.degrees(bank.residual)), 3),
            "residuals": "RMS; drag and thrust on held-out flights, relative",
        },
    }


def write_point_mass(path: Path, contents: dict[str, Any]) -> None:
    """Write `point_mass.toml`, having seen that it is valid."""
    import tomli_w

    PointMass(**contents)
    header = (
        f"# Made by `{contents['identification']['command']}`; how and how well it was fitted is\n"
        "# under [identification]. docs/aircraft.md explains the method. SI, rad.\n\n"
    )
    path.write_text(header + tomli_w.dumps(contents), encoding="utf-8")


def _fly(
    aircraft: Aircraft, area: float, tests: Callable[..., Any], progress: Progress
) -> list[npt.NDArray[Any]]:
    records = []
    for manoeuvre in tests(aircraft.flight_test):
        record = fly_manoeuvre(aircraft, manoeuvre, area)
        flown = 0 if record is None else record.size
        progress(
            f"{manoeuvre.name} at {manoeuvre.airspeed:.0f} m/s, {manoeuvre.altitude:.0f} m: "
            + (f"{flown * DT:.0f} s" if flown > SHORTEST else "no trim, or at once out of range")
        )
        if record is not None and flown > SHORTEST:
            records.append(record)
    if not records:
        raise AircraftError(f"aircraft {aircraft.name!r}: no test flight could be flown")
    return records


def _airframe(aircraft: Aircraft) -> dict[str, Any]:
    """What the aircraft's data sheet says: reference area, masses, engines."""
    import jsbsim

    fdm = load(aircraft, woven_aircraft(aircraft, True), DT)
    capacity = 0.0
    for tank in aircraft.fuel_tanks:
        contents = fdm[f"propulsion/tank[{tank}]/contents-lbs"]
        capacity += 100.0 * contents / fdm[f"propulsion/tank[{tank}]/pct-full"]
        fdm[f"propulsion/tank[{tank}]/contents-lbs"] = 0.0
    fdm.run_ic()
    return {
        "area": round(fdm["metrics/Sw-sqft"] * FOOT**2, 6),
        "empty": round(fdm["inertia/weight-lbs"] * POUND_MASS, 3),
        "fuel_capacity": round(capacity * POUND_MASS, 3),
        "engines": engine_count(fdm),
        "jsbsim": jsbsim.__version__,
    }


def _thrust_residual(
    records: list[npt.NDArray[Any]], deck: Deck, spool_up: Array, spool_down: Array
) -> Array:
    """(Thrust from throttle through deck and spool - thrust flown) / maximum thrust."""
    from ftc_jsb.point_mass.atmosphere import standard_atmosphere
    from ftc_jsb.point_mass.model import MODEL

    model = np.zeros(1, MODEL)
    model[0]["spool_up"], model[0]["spool_down"] = spool_up, spool_down
    residuals = []
    for record in records:
        idle, military, maximum = deck.levels(record)
        speed = np.clip(record["throttle"], 0.0, 1.0)
        for i in range(1, record.size):
            density, _ = standard_atmosphere(record["altitude"][i])
            up = bool(speed[i] > speed[i - 1])
            most = spool_rate(model[0], speed[i - 1], density, up) * DT
            speed[i] = speed[i - 1] + np.clip(speed[i] - speed[i - 1], -most, most)
        dry = idle + (military - idle) * speed**2
        thrust = dry + np.clip(record["throttle"] - 1.0, 0.0, 1.0) * (maximum - dry)
        residuals.append(((thrust - record["thrust"]) / maximum)[20:])
    return np.concatenate(residuals)


def _rounded(values: Array, digits: int) -> Any:
    return np.round(np.asarray(values, dtype=float), digits).tolist()


def _range(values: Array) -> list[float]:
    return [round(float(values.min()), 3), round(float(values.max()), 3)]


def _percent(error: Array) -> float:
    return round(100.0 * float(np.sqrt(np.mean(error**2))), 3)
