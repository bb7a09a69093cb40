"""The range in which an aircraft can be tested: stall, level speeds that thrust pays for, ceiling."""

import math
from typing import Any, NamedTuple

import numpy as np

from ftc_jsb.aircraft.airplane_class import HEAVY, LIGHT
from ftc_jsb.aircraft.description import FlightTest
from ftc_jsb.aircraft.test_range import REFERENCE_ALTITUDE, SOUND_SPEED
from ftc_jsb.draft.probe import hold
from ftc_jsb.draft.trimmed_polar import TrimmedPolar, trimmed_polar
from ftc_jsb.errors import AircraftError
from ftc_jsb.point_mass.atmosphere import standard_atmosphere
from ftc_jsb.units import POUND_FORCE, STANDARD_GRAVITY

MACH = tuple(round(0.05 * number, 2) for number in range(3, 22))  # 0.15 to 1.05
USABLE_LIFT = 0.85  # of the greatest: what tests go up to
STALL_MARGIN = 1.2  # of the speed of steady flight at that lift
THRUST_MARGIN = 1.05  # of the drag, that maximum thrust must have
ALTITUDES = (762.0, 3048.0, 6096.0, 9144.0)  # [m] to be tested, up to
CEILING_SHARE = 0.85  # of the ceiling
HIGHEST = 18000.0  # [m]
CLIMB_STEP = 762.0  # [m]
FUEL = (0.2, 0.43, 0.8)  # of internal fuel, to be tested
HEAVY_FUEL = 0.8
KINK = 0.5  # of C_D, by which dC_D / dM jumps at a Mach number that is a break
KINK_STEP = 0.01
SMALL_ALPHA = 0.03  # [rad]

# Load factors that the tests go to. Those of the regulations: 14 CFR 25.337 and 23.337 (utility);
# of a fighter, what the shipped ones are flown to at least.
TRANSPORT, UTILITY, FIGHTER = (0.0, 2.5), (-1.76, 4.4), (-2.0, 6.0)
FIGHTER_THRUST = 0.5  # of the weight, from which an aircraft that is not heavy counts as a fighter


class Masses(NamedTuple):
    """Of an aircraft [kg]."""

    empty: float  # without internal fuel
    fuel: float  # internal, tanks full


def flight_test(fdm: Any, masses: Masses, area: float) -> FlightTest:
    """Speeds, altitudes, load factors and lift that the tests of an aircraft go to.

    Args:
        fdm: the woven aircraft of `probe.loaded`, engines off.
        masses: of the aircraft.
        area: reference area [m^2].

    Raises:
        AircraftError: it cannot fly level at 3048 m or below.
    """
    name = f"aircraft {fdm.get_model_name()!r}"
    polar = trimmed_polar(fdm, MACH, SOUND_SPEED)
    peaks = polar.lift_max()
    if not np.isfinite(peaks).any():
        raise AircraftError(
            f"{name}: no elevator balances it at any angle of attack from -4 to 24 deg"
        )
    usable = USABLE_LIFT * float(np.nanmin(peaks[: len(peaks) // 2 + 1]))
    heavy = (masses.empty + HEAVY_FUEL * masses.fuel) * STANDARD_GRAVITY
    half = (masses.empty + 0.5 * masses.fuel) * STANDARD_GRAVITY
    density = standard_atmosphere(0.0)[0]
    slow = STALL_MARGIN * math.sqrt(2.0 * heavy / (density * area * usable))
    fastest = _fastest(fdm, polar, half, area, usable, REFERENCE_ALTITUDE)
    if not fastest > slow:
        raise AircraftError(
            f"{name}: no level flight at {REFERENCE_ALTITUDE:g} m: at no Mach number from "
            f"{MACH[0]:g} to {MACH[-1]:g} its thrust is {THRUST_MARGIN:g} times the drag with "
            f"C_L up to {usable:.2f}"
        )
    heights = np.arange(CLIMB_STEP, HIGHEST, CLIMB_STEP)
    paid = [h for h in heights if _fastest(fdm, polar, half, area, usable, h) > 0.0]
    ceiling = max(paid, default=REFERENCE_ALTITUDE)
    static = _most_thrust(fdm, MACH[0], 0.0)
    load_factor = load_factor_range(half / STANDARD_GRAVITY, static / half)
    high = round(fastest / 5.0) * 5.0
    return FlightTest(
        airspeed=(round(slow), high),
        altitude=tuple(h for h in ALTITUDES if h <= max(CEILING_SHARE * ceiling, ALTITUDES[1])),
        fuel_fraction=FUEL,
        load_factor=load_factor,
        lift_coefficient_max=round(usable, 2),
        mach_breaks=_breaks(fdm, slow / SOUND_SPEED, high / SOUND_SPEED),
    )


def load_factor_range(mass: float, thrust_to_weight: float) -> tuple[float, float]:
    """Load factors of tests, by mass [kg] and static thrust over weight: JSBSim has none."""
    if mass < HEAVY and thrust_to_weight >= FIGHTER_THRUST:
        return FIGHTER
    return UTILITY if mass <= LIGHT else TRANSPORT


def _most_thrust(fdm: Any, mach: float, altitude: float) -> float:
    """Maximum thrust [N] of all engines, healthy."""
    hold(fdm, mach * standard_atmosphere(altitude)[1], altitude, SMALL_ALPHA)
    fdm.run()
    return float(fdm["ftc/deck/maximum-lbs"]) * POUND_FORCE


def _fastest(
    fdm: Any, polar: TrimmedPolar, weight: float, area: float, usable: float, altitude: float
) -> float:
    """Highest airspeed [m/s] of level flight at an altitude [m]; 0 if there is none."""
    density, sound_speed = standard_atmosphere(altitude)
    level = 0.0
    for mach in MACH:
        force = 0.5 * density * (mach * sound_speed) ** 2 * area
        lift = weight / force
        if lift > usable:
            continue
        drag = polar.drag_at(mach, lift) * force
        if _most_thrust(fdm, mach, altitude) >= THRUST_MARGIN * drag:
            level = mach * sound_speed
    return level


def _breaks(fdm: Any, low: float, high: float) -> tuple[float, ...]:
    """Mach numbers at which the slope of drag over Mach jumps, as at the start of a drag rise."""
    numbers = np.arange(round(low, 2), high, KINK_STEP)
    drag = []
    for mach in numbers:
        hold(fdm, float(mach) * SOUND_SPEED, REFERENCE_ALTITUDE, SMALL_ALPHA)
        fdm.run()
        drag.append(fdm["forces/fwx-aero-lbs"] / fdm["aero/qbar-psf"] / fdm["metrics/Sw-sqft"])
    jump = np.diff(drag, 2) / KINK_STEP
    kinks = np.flatnonzero(np.abs(jump) > KINK * np.mean(drag)) + 1
    return tuple(round(float(numbers[i]), 2) for i in kinks)
