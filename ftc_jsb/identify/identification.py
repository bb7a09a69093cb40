"""`identify`: from virtual flight tests to a `point_mass.toml` with ranges and residuals."""

from collections.abc import Callable
from typing import Any

import numpy.typing as npt

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.errors import AircraftError
from ftc_jsb.identify import manoeuvres
from ftc_jsb.identify.angles_drag import fit_angles_drag
from ftc_jsb.identify.flight_test import fly_manoeuvre
from ftc_jsb.identify.fuel_consumption import fit_consumption
from ftc_jsb.identify.inner_loop_lag import fit_lag
from ftc_jsb.identify.measured_lift import fit_measured_lift
from ftc_jsb.identify.point_mass_contents import FittedModel, FlownTests, contents
from ftc_jsb.identify.polar import fit_alpha, fit_polar
from ftc_jsb.identify.samples import joined, samples
from ftc_jsb.identify.side_force import fit_side_force
from ftc_jsb.identify.spool import fit_spool
from ftc_jsb.identify.thrust_deck import fit_deck
from ftc_jsb.six_dof.commanded_flight import DT
from ftc_jsb.six_dof.data_sheet import data_sheet

Progress = Callable[[str], None]
IN_GUSTS = 0.2  # that a sample in gusts counts, beside one in still air
SHORTEST = 100  # samples of a test flight that is worth keeping


PLANS = (  # as `FlownTests` has them
    manoeuvres.training,
    manoeuvres.training_in_gusts,
    manoeuvres.held_out,
    manoeuvres.held_out_in_gusts,
)


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
    sheet = data_sheet(aircraft)
    sheet = sheet._replace(area=round(sheet.area, 6))  # as the file has it

    def flown(plan: Callable[..., Any]) -> tuple[list[npt.NDArray[Any]], int]:
        return _fly(aircraft, sheet.area, plan, progress)

    recorded, without = zip(*map(flown, PLANS), strict=True)
    training, gusty, held_out, held_out_gusty = recorded
    tests = FlownTests(training, gusty, held_out, held_out_gusty, sum(without))
    fitted = [*tests.fitted, *tests.fitted_in_gusts]
    progress(f"fitting {sum(map(len, fitted)) * DT:.0f} s of flight")
    return contents(aircraft, sheet, tests, _fit(aircraft, sheet.area, tests))


def steps(aircraft: Aircraft) -> int:
    """How often `identify` says what is being done: once a flight, and for the fit."""
    return 1 + sum(sum(1 for _ in plan(aircraft.flight_test)) for plan in PLANS)


def _fit(aircraft: Aircraft, area: float, tests: FlownTests) -> FittedModel:
    """Every part of the point mass, the polar from the drag that is left without sideslip.

    Drag, lift and side force are those of all flights, what follows commands that of still air. Gusts turn the
    air about the aircraft, which no gyro sees, and JSBSim takes induced drag from the frame before: in drag and
    lift over angle of attack their samples count less.
    """
    records = tests.fitted
    still = samples(records, area)
    data = joined(still, samples(tests.fitted_in_gusts, area, IN_GUSTS))
    breaks = aircraft.flight_test.mach_breaks
    angles = fit_angles_drag(data, breaks)
    polar = fit_polar(data._replace(drag=data.drag - angles.of_sideslip(data)), breaks)
    alpha = fit_alpha(still, polar.mach)
    deck = fit_deck(records)
    spool_up, spool_down = fit_spool(records, deck)
    return FittedModel(
        polar,
        alpha,
        angles,
        fit_measured_lift(data, angles),
        fit_side_force(data, angles),
        deck,
        spool_up,
        spool_down,
        fit_consumption(records),
        load_factor=fit_lag(records, "load_factor", DT),
        bank=fit_lag(records, "bank_angle", DT, limited=True),
    )


def _fly(
    aircraft: Aircraft, area: float, tests: Callable[..., Any], progress: Progress
) -> tuple[list[npt.NDArray[Any]], int]:
    """Recordings, and how many flights could not be flown."""
    records, without = [], 0
    for manoeuvre in tests(aircraft.flight_test):
        record = fly_manoeuvre(aircraft, manoeuvre, area)
        flown = 0 if record is None else record.size
        progress(
            f"{manoeuvre.name} at {manoeuvre.airspeed:.0f} m/s, {manoeuvre.altitude:.0f} m: "
            + (f"{flown * DT:.0f} s" if flown > SHORTEST else "no trim, or at once out of range")
        )
        if record is not None and flown > SHORTEST:
            records.append(record)
        else:
            without += 1
    if not records:
        raise AircraftError(f"aircraft {aircraft.name!r}: no test flight could be flown")
    return records, without
