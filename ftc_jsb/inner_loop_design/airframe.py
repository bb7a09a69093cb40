"""What the inner loop must know of an airframe, measured on the woven aircraft by perturbation."""

import math
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.aircraft.test_range import REFERENCE_ALTITUDE, SOUND_SPEED
from ftc_jsb.errors import AircraftError, TrimError
from ftc_jsb.scenario.schema import Initial
from ftc_jsb.six_dof.loading import initialise, load
from ftc_jsb.six_dof.trim import set_condition, trimmed

DT = 0.005  # [s]
FUEL = 0.5  # of internal fuel
PERTURBATION = 0.05  # of a command that goes from -1 to 1
LARGE = 0.5  # of such a command, to see how fast the surface goes
ARRIVAL = 0.4  # [s] by which it has arrived
FRAMES = 5  # after a perturbation: surfaces have arrived, the aircraft has hardly moved
LOAD_FACTORS = (0.5, 4.0)  # between which the lift slope is taken
ALPHA_STEP = math.radians(0.5)
RATE_SHARE = 0.99  # of a surface's own rate that the loop asks for
RATE_MAX = 6.6  # [1/s] where a surface has no actuator and would follow at once
ROLL_TIME = 1.0  # [s] of full aileron
ROLL_SHARE = 0.8  # of the roll rate there that the bank reference may ask for
ROLL_RATE_MAX = 3.5  # [rad/s]

ACCELERATION = {"elevator": "qdot", "aileron": "pdot", "rudder": "rdot"}


class Airframe(NamedTuple):
    """Numbers of an airframe, most over Mach."""

    mach: tuple[float, ...]
    lift_slope: tuple[float, ...]  # [1/rad]
    effectiveness: dict[str, tuple[float, ...]]  # of a unit command [rad/s2/psf], for each surface
    roll_rate: tuple[float, ...]  # [rad/s] that the bank reference may ask for
    rate: dict[str, float]  # [1/s], of a command that goes from -1 to 1


def measure(aircraft: Aircraft, root: Path, mach: tuple[float, ...]) -> Airframe:
    """Lift slope, angular accelerations and surface rates of a woven aircraft.

    A surface command is perturbed to both sides of its trim; half the difference of the angular
    accelerations a few frames later, over perturbation and dynamic pressure, is its effectiveness.

    Args:
        aircraft: as loaded.
        root: of the woven aircraft; its inner loop stays disengaged.
        mach: numbers at which to measure.

    Raises:
        AircraftError: nowhere a trim, or a surface that turns nothing.
    """
    flown: list[float] = []
    slope: list[float] = []
    roll: list[float] = []
    found: dict[str, list[float]] = {name: [] for name in ACCELERATION}
    for number in mach:
        initial = Initial(airspeed=number * SOUND_SPEED, altitude=REFERENCE_ALTITUDE)
        try:
            values = {
                name: _control_effectiveness(aircraft, root, initial, name) for name in ACCELERATION
            }
        except TrimError:
            continue
        flown.append(number)
        slope.append(_lift_slope(aircraft, root, initial))
        roll.append(_roll_rate(aircraft, root, initial))
        for name, value in values.items():
            found[name].append(value)
    if not flown:
        raise AircraftError(
            f"aircraft {aircraft.name!r}: no trim from Mach {mach[0]:g} to {mach[-1]:g} at "
            f"{REFERENCE_ALTITUDE:g} m; the inner loop cannot be designed"
        )
    for name, effectiveness in found.items():
        if min(effectiveness) * max(effectiveness) <= 0.0:
            raise AircraftError(
                f"aircraft {aircraft.name!r}: fcs/{name}-cmd-norm turns the aircraft by "
                f"{effectiveness} rad/s2/psf over Mach; expected one sign"
            )
    cruise = Initial(airspeed=flown[len(flown) // 2] * SOUND_SPEED, altitude=REFERENCE_ALTITUDE)
    return Airframe(
        tuple(flown),
        tuple(slope),
        {name: tuple(effectiveness) for name, effectiveness in found.items()},
        tuple(roll),
        {name: _rate(aircraft, root, cruise, name) for name in ACCELERATION},
    )


def _perturbed(
    aircraft: Aircraft, root: Path, initial: Initial, surface: str, perturbation: float
) -> Any:
    fdm = trimmed(aircraft, root, DT, initial, FUEL)
    fdm[f"fcs/{surface}-cmd-norm"] = fdm[f"fcs/{surface}-cmd-norm"] + perturbation
    return fdm


def _control_effectiveness(aircraft: Aircraft, root: Path, initial: Initial, surface: str) -> float:
    accelerations = []
    pressure = 1.0
    for side in (-1.0, 1.0):
        fdm = _perturbed(aircraft, root, initial, surface, side * PERTURBATION)
        for _ in range(FRAMES):
            fdm.run()
        accelerations.append(fdm[f"accelerations/{ACCELERATION[surface]}-rad_sec2"])
        pressure = fdm["aero/qbar-psf"]
    return float((accelerations[1] - accelerations[0]) / (2.0 * PERTURBATION * pressure))


def _rate(aircraft: Aircraft, root: Path, initial: Initial, surface: str) -> float:
    """From how much of its way a surface has gone in one frame of a large command, the slower side."""
    position = getattr(aircraft.surfaces, surface)[0].property
    shares = []
    for step in (-LARGE, LARGE):
        fdm = _perturbed(aircraft, root, initial, surface, step)
        start = fdm[position]
        fdm.run()
        first = fdm[position] - start
        for _ in range(round(ARRIVAL / DT)):
            fdm.run()
        whole = fdm[position] - start
        shares.append(abs(first / whole) if whole != 0.0 else 1.0)
    return min(RATE_SHARE * LARGE * min(shares) / DT, RATE_MAX)


def _roll_rate(aircraft: Aircraft, root: Path, initial: Initial) -> float:
    """ROLL_SHARE of the fastest roll in ROLL_TIME of full aileron, within ROLL_RATE_MAX."""
    fdm = _perturbed(aircraft, root, initial, "aileron", 1.0)
    fastest = 0.0
    for _ in range(round(ROLL_TIME / DT)):
        fdm.run()
        fastest = max(fastest, abs(fdm["velocities/p-rad_sec"]))
    return min(ROLL_SHARE * fastest, ROLL_RATE_MAX)


def _lift_slope(aircraft: Aircraft, root: Path, initial: Initial) -> float:
    """Least squares of C_L over alpha at the trim's surfaces, where n is in LOAD_FACTORS."""
    trim = trimmed(aircraft, root, DT, initial, FUEL)
    weight, pressure = trim["inertia/weight-lbs"], trim["aero/qbar-psf"]
    area = trim["metrics/Sw-sqft"]
    alphas, coefficients = [], []
    for alpha in trim["aero/alpha-rad"] + ALPHA_STEP * np.arange(-4, 13):
        fdm = load(aircraft, root, DT)
        set_condition(aircraft, fdm, initial, FUEL)
        fdm["ic/alpha-rad"] = alpha
        for surface in ACCELERATION:
            fdm[f"fcs/{surface}-cmd-norm"] = trim[f"fcs/{surface}-cmd-norm"]
        fdm["fcs/pitch-trim-cmd-norm"] = trim["fcs/pitch-trim-cmd-norm"]
        initialise(fdm, aircraft.name)
        lift = fdm["forces/fbx-aero-lbs"] * math.sin(alpha)
        lift -= fdm["forces/fbz-aero-lbs"] * math.cos(alpha)
        if LOAD_FACTORS[0] <= lift / weight <= LOAD_FACTORS[1]:
            alphas.append(alpha)
            coefficients.append(lift / (pressure * area))
    if len(alphas) < 3:
        raise AircraftError(
            f"aircraft {aircraft.name!r}: no lift slope at {initial.airspeed:g} m/s: load factors "
            f"{LOAD_FACTORS[0]:g} to {LOAD_FACTORS[1]:g} lie within {len(alphas)} steps of alpha"
        )
    return float(np.polyfit(alphas, coefficients, 1)[0])
