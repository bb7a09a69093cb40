"""Speeds, altitudes and Mach numbers of tests, as they follow from an aircraft's test range."""

import math

from ftc_jsb.aircraft.description import Aircraft, FlightTest
from ftc_jsb.errors import AircraftError

SCALE_HEIGHT = 9000.0  # [m], of the density of the lower atmosphere
ALTITUDES = (1500.0, 4000.0)  # [m] at which inner loops are designed
SPEED_MARGINS = (1.15, 0.92)  # at the ends of the test range: no step leaves it
MACH_STEP, FINE_MACH_STEP = 0.1, 0.05
MACH_MARGIN = 0.005  # below the fastest: an aircraft must trim there
FINE_FROM = 0.8  # Mach number from which drag rises
REFERENCE_ALTITUDE = 3048.0  # [m], 10 000 ft: that of the scenarios
SOUND_SPEED = 328.387  # [m/s] there


def slowest(test: FlightTest, altitude: float) -> float:
    """Airspeed [m/s] of the slowest test at an altitude [m]: the same dynamic pressure everywhere."""
    return max(test.airspeed[0], _same_pressure(test, altitude))


def _same_pressure(test: FlightTest, altitude: float) -> float:
    sea_level = test.airspeed[0] if test.slowest is None else test.slowest
    return sea_level * math.exp(altitude / 2.0 / SCALE_HEIGHT)


def usual_altitude(test: FlightTest) -> float:
    """Altitude [m] that was tested and is nearest to 10 000 ft."""
    return min(test.altitude, key=lambda height: abs(height - REFERENCE_ALTITUDE))


def design_altitudes(test: FlightTest) -> tuple[float, float]:
    """Altitudes [m] at which an inner loop is designed: lower for an aircraft of a low ceiling."""
    share = min(1.0, max(test.altitude) / ALTITUDES[1])
    return ALTITUDES[0] * share, ALTITUDES[1] * share


def design_airspeeds(aircraft: Aircraft) -> tuple[float, ...]:
    """Airspeeds [m/s] at which an inner loop is designed: those of the file, or ends and middle.

    Raises:
        AircraftError: the test range has no room for them.
    """
    if aircraft.inner_loop.design_airspeeds:
        return aircraft.inner_loop.design_airspeeds
    low, high = _ends(aircraft)
    return low, round((low + high) / 2.0), high


def step_airspeeds(aircraft: Aircraft) -> tuple[float, ...]:
    """Airspeeds [m/s] at which it is judged: those of the file, or between those of the design.

    Raises:
        AircraftError: the test range has no room for them.
    """
    if aircraft.inner_loop.step_airspeeds:
        return aircraft.inner_loop.step_airspeeds
    low, high = _ends(aircraft)
    return round(0.75 * low + 0.25 * high), round(0.25 * low + 0.75 * high)


def _ends(aircraft: Aircraft) -> tuple[float, float]:
    test = aircraft.flight_test
    low = round(SPEED_MARGINS[0] * slowest(test, design_altitudes(test)[1]))
    high = round(SPEED_MARGINS[1] * test.airspeed[1])
    if low >= high:
        raise AircraftError(
            f"aircraft {aircraft.name!r}, flight_test.airspeed: from {low:g} m/s, {SPEED_MARGINS[0]:g} "
            f"times the slowest test at {design_altitudes(test)[1]:.0f} m, to {high:g} m/s there is no "
            "room to design an inner loop"
        )
    return low, high


def mach_numbers(test: FlightTest) -> tuple[float, ...]:
    """Mach numbers of the test range at 10 000 ft at which an airframe is measured."""
    low, high = (airspeed / SOUND_SPEED for airspeed in test.airspeed)
    first = max(round(low / MACH_STEP), 1)
    coarse = [number * MACH_STEP for number in range(first, round(FINE_FROM / MACH_STEP) + 1)]
    fine = [FINE_FROM + (n + 1) * FINE_MACH_STEP for n in range(round(1.0 / FINE_MACH_STEP))]
    numbers = tuple(round(mach, 2) for mach in (*coarse, *fine) if mach <= high - MACH_MARGIN)
    return numbers or (round((low + high) / 2.0, 2),)
