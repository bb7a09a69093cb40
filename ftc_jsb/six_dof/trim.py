"""A woven JSBSim aircraft trimmed at the initial condition, and checked to hold the trim."""

import math
from pathlib import Path
from typing import Any

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.errors import TrimError
from ftc_jsb.scenario.schema import Initial
from ftc_jsb.six_dof.engines import engine_count
from ftc_jsb.six_dof.fuel_tanks import fill_tanks
from ftc_jsb.six_dof.loading import initialise, load
from ftc_jsb.six_dof.properties import node, write_checked
from ftc_jsb.units import FOOT

HOLD = 3.0  # [s] of hands-off flight that the trim must survive
SPEED_DRIFT = 1.0  # [m/s] that it may drift by then
PATH_DRIFT = 0.5  # [deg]
_HELD: set[tuple[Path, float, Initial, float]] = set()  # trims that this process has seen hold


def trimmed(
    aircraft: Aircraft,
    root: Path,
    dt: float,
    initial: Initial,
    fuel_fraction: float,
) -> Any:
    """A fresh `jsbsim.FGFDMExec`, trimmed, engines running; inner loop not engaged.

    Args:
        aircraft, root, dt: as for `load`.
        initial: condition to trim at.
        fuel_fraction: of internal fuel.

    Raises:
        TrimError: no trim, or one that hands-off flight leaves; with the residuals.
        AircraftError: the aircraft cannot be loaded or set up.
    """
    condition = (root, dt, initial, fuel_fraction)  # the root is named after the whole aircraft
    if condition not in _HELD:
        _check_hold(aircraft, _trim(aircraft, root, dt, initial, fuel_fraction), initial)
        _HELD.add(condition)
    return _trim(aircraft, root, dt, initial, fuel_fraction)  # the same, at time zero


def set_condition(aircraft: Aircraft, fdm: Any, initial: Initial, fuel_fraction: float) -> None:
    """Initial condition, set-up and fuel of a loaded aircraft, before `run_ic`.

    Raises:
        AircraftError: a property is missing or read-only, or a fuel tank is empty.
    """
    conditions = {
        "ic/h-sl-ft": initial.altitude / FOOT,
        "ic/vt-fps": initial.airspeed / FOOT,
        "ic/gamma-deg": initial.flight_path_deg,
        "ic/psi-true-deg": initial.heading_deg % 360.0,
        "ic/lat-geod-deg": initial.latitude_deg,
        "ic/long-gc-deg": initial.longitude_deg,
    }
    for name, value in conditions.items():
        node(fdm, name)
        fdm[name] = value
    for name, value in aircraft.setup.items():
        write_checked(fdm, name, value)
    fill_tanks(aircraft, fdm, fuel_fraction)


def _trim(
    aircraft: Aircraft,
    root: Path,
    dt: float,
    initial: Initial,
    fuel_fraction: float,
) -> Any:
    fdm = load(aircraft, root, dt)
    set_condition(aircraft, fdm, initial, fuel_fraction)
    initialise(fdm, aircraft.name)
    fdm["propulsion/set-running"] = -1
    try:
        fdm["simulation/do_simple_trim"] = 1
    except Exception as error:
        raise TrimError(_failure(aircraft, fdm, initial, str(error))) from None
    return fdm


def _check_hold(aircraft: Aircraft, fdm: Any, initial: Initial) -> None:
    for number in range(engine_count(fdm)):
        if fdm[f"propulsion/engine[{number}]/set-running"] != 1.0:
            raise TrimError(
                f"aircraft {aircraft.name!r}: engine {number} does not run after the trim"
            )
    path = math.degrees(fdm["flight-path/gamma-rad"])
    while fdm.get_sim_time() < HOLD:
        fdm.run()
    speed_drift = fdm["velocities/vt-fps"] * FOOT - initial.airspeed
    path_drift = math.degrees(fdm["flight-path/gamma-rad"]) - path
    if not (abs(speed_drift) < SPEED_DRIFT and abs(path_drift) < PATH_DRIFT):
        drift = (
            f"the trim does not hold: hands off for {HOLD:g} s, airspeed drifts by "
            f"{speed_drift:.2f} m/s and flight path by {path_drift:.2f} deg"
        )
        raise TrimError(_failure(aircraft, fdm, initial, drift))


def _failure(aircraft: Aircraft, fdm: Any, initial: Initial, what: str) -> str:
    units = {"udot-ft_sec2": FOOT, "vdot-ft_sec2": FOOT, "wdot-ft_sec2": FOOT}
    units |= {"pdot-rad_sec2": 1.0, "qdot-rad_sec2": 1.0, "rdot-rad_sec2": 1.0}
    residuals = ", ".join(
        f"{name.split('-')[0]} {fdm[f'accelerations/{name}'] * factor:.3g} "
        + ("m/s2" if factor == FOOT else "rad/s2")
        for name, factor in units.items()
    )
    return (
        f"aircraft {aircraft.name!r}: no trim at {initial.airspeed:g} m/s, {initial.altitude:g} m, "
        f"flight path {initial.flight_path_deg:g} deg: {' '.join(what.split())}. Residuals: {residuals}; "
        f"throttle {fdm['fcs/throttle-cmd-norm']:.2f}, alpha {fdm['aero/alpha-deg']:.1f} deg. "
        f"It was tested from {aircraft.flight_test.airspeed[0]:g} to {aircraft.flight_test.airspeed[1]:g} m/s"
    )
