"""Search for the fastest references that an airframe follows, over a grid of flight conditions."""

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

from ftc_jsb.aircraft.description import Aircraft
from ftc_jsb.aircraft.test_range import design_airspeeds, design_altitudes
from ftc_jsb.errors import AircraftError, TrimError
from ftc_jsb.inner_loop_design.handling import CLASSES, Handling, class_of, largest_step
from ftc_jsb.inner_loop_design.step_commands import bank_step, load_factor_step, most_pulled
from ftc_jsb.inner_loop_design.step_flights import fly_commands
from ftc_jsb.inner_loop_design.step_response import StepResponse, step_response
from ftc_jsb.scenario.schema import Initial
from ftc_jsb.six_dof.data_sheet import data_sheet

Progress = Callable[[str], None]

LOAD_FACTOR, BANK = "load-factor", "bank"  # as in the inner loop's properties
FUEL = (0.2, 0.8)  # of internal fuel
FEWEST = 0.5  # of the conditions that must trim
LOAD_FACTOR_OVERSHOOT, LOAD_FACTOR_FOLLOWING = 0.08, 0.15  # of the step
BANK_OVERSHOOT, BANK_FOLLOWING = 0.03, 0.13
SETTLING_SHARE = 0.85  # of the published time


class NotFollowedError(AircraftError):
    """No reference of an axis is followed at every condition."""


class Criterion(NamedTuple):
    """What every step of the search must keep: the published criteria, with a margin."""

    overshoot: float  # of the step
    settling: float  # [s] to 5 %; inf = not asked for
    sideslip: float  # [rad]
    following: float  # RMS distance from the reference, of the step


class Axis(NamedTuple):
    """A reference to be searched for."""

    name: str  # LOAD_FACTOR or BANK
    frequencies: tuple[float, ...]  # [rad/s], to be tried in this order
    criterion: Criterion


def axes(handling: Handling) -> tuple[Axis, Axis]:
    """Load factor and bank of a class: the published criteria, with a margin."""
    pulled = Criterion(
        LOAD_FACTOR_OVERSHOOT, math.inf, handling.roll_sideslip, LOAD_FACTOR_FOLLOWING
    )
    settling = SETTLING_SHARE * handling.bank_settling
    rolled = Criterion(BANK_OVERSHOOT, settling, handling.roll_sideslip, BANK_FOLLOWING)
    return (
        Axis(LOAD_FACTOR, handling.load_factor_frequencies, pulled),
        Axis(BANK, handling.bank_frequencies, rolled),
    )


def search_grid(aircraft: Aircraft, axis: str) -> Iterator[tuple[Initial, float]]:
    """Level flight and fuel fraction at each point of the grid within the aircraft's test range.

    For load factor also the highest altitude tested, at all but the slowest airspeed: there an
    aircraft rings first, for want of pressure on its tail.

    Args:
        aircraft: as loaded.
        axis: LOAD_FACTOR or BANK.

    Raises:
        AircraftError: the test range has no room.
    """
    low, high = aircraft.flight_test.airspeed
    altitudes = design_altitudes(aircraft.flight_test)
    airspeeds = design_airspeeds(aircraft)
    points = [(airspeed, altitude) for airspeed in airspeeds for altitude in altitudes]
    highest = max(aircraft.flight_test.altitude)
    if axis == LOAD_FACTOR and highest > altitudes[-1]:
        points += [(airspeed, highest) for airspeed in airspeeds[1:]]
    for airspeed, altitude in points:
        if low <= airspeed <= high:
            for fuel in FUEL:
                yield Initial(airspeed=airspeed, altitude=altitude), fuel


def fastest_reference(
    aircraft: Aircraft,
    axis: Axis,
    numbers: dict[str, float],
    progress: Progress,
) -> float:
    """The first frequency [rad/s] of an axis whose steps keep its criterion at every condition.

    Args:
        aircraft: woven with its measured airframe.
        axis: to be searched.
        numbers: properties of the inner loop that are decided already.
        progress: told what is being done, a line at a time.

    Raises:
        NotFollowedError: there is none.
        AircraftError: no trim at more than half of the conditions.
    """
    conditions = list(search_grid(aircraft, axis.name))  # those that do not trim are left out
    remaining, asked = list(conditions), len(conditions)
    if not conditions:
        raise AircraftError(
            f"aircraft {aircraft.name!r}: no airspeed of inner_loop.design_airspeeds lies within "
            "flight_test.airspeed"
        )
    unmet = ""
    for frequency in axis.frequencies:
        for condition in remaining:
            try:
                response, sideslip = fly_step(
                    aircraft,
                    axis.name,
                    *condition,
                    {**numbers, f"ftc/{axis.name}/frequency": frequency},
                )
            except TrimError as error:  # too heavy, too slow or too fast for this aircraft
                conditions = [other for other in conditions if other != condition]
                if len(conditions) < FEWEST * asked:
                    raise AircraftError(
                        f"aircraft {aircraft.name!r}: no trim at more than half of the {asked} "
                        f"conditions of the design; the last: {error}"
                    ) from None
                continue
            unmet = _unmet(response, sideslip, axis.criterion)
            if unmet:
                where = f"{condition[0].airspeed:g} m/s, {condition[0].altitude:g} m, fuel {condition[1]:g}"
                progress(f"{axis.name} {frequency:g} rad/s: {unmet} at {where}")
                # the hardest condition first: what broke one frequency most likely breaks the next
                remaining = [condition, *(c for c in conditions if c != condition)]
                break
        else:
            progress(
                f"{axis.name} {frequency:g} rad/s: kept at {len(conditions)} of {asked} conditions"
            )
            return frequency
    raise NotFollowedError(
        f"aircraft {aircraft.name!r}: no {axis.name} reference down to "
        f"{axis.frequencies[-1]:g} rad/s is followed: {unmet}"
    )


def fly_step(
    aircraft: Aircraft,
    axis: str,
    initial: Initial,
    fuel_fraction: float,
    numbers: dict[str, float] | None = None,
) -> tuple[StepResponse, float]:
    """A step of `load-factor` or `bank` and its largest sideslip [rad].

    Args:
        aircraft: woven with its measured airframe.
        axis: which.
        initial: condition at the start.
        fuel_fraction: of internal fuel.
        numbers: properties of the inner loop to be set.

    Raises:
        TrimError: no trim there.
    """
    handling = CLASSES[class_of(aircraft)]
    seconds = handling.step_time
    if axis == BANK:
        last = handling.bank_step
        flown = fly_commands(aircraft, initial, fuel_fraction, bank_step(last), seconds, numbers)
        value, reference = flown.record["bank_angle"], flown.bank_reference
        first = 0.0
    else:
        at_start = fly_commands(aircraft, initial, fuel_fraction, load_factor_step(1.0), 0.02)
        lift, area = aircraft.flight_test.lift_coefficient_max, data_sheet(aircraft).area
        most = most_pulled(lift, area, at_start.record[0])
        last = min(largest_step(aircraft), handling.pull_share * most)
        flown = fly_commands(
            aircraft, initial, fuel_fraction, load_factor_step(last), seconds, numbers
        )
        value, reference = flown.record["load_factor"], flown.load_factor_reference
        first = 1.0
    response = step_response(flown.record["time"], value, reference, first, last)
    return response, float(abs(flown.record["sideslip"]).max())


def _unmet(response: StepResponse, sideslip: float, criterion: Criterion) -> str:
    """Which part of the criterion is not kept; empty if all is."""
    if response.overshoot > criterion.overshoot:
        return f"overshoot {100.0 * response.overshoot:.1f} %"
    if response.settling > criterion.settling:
        return f"settled after {response.settling:.2f} s"
    if sideslip > criterion.sideslip:
        return f"sideslip {sideslip:.3f} rad"
    if response.following > criterion.following:
        return f"{100.0 * response.following:.1f} % RMS from the reference"
    return ""
