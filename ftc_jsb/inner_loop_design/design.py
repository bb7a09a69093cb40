"""The inner loop's numbers by a repeatable search: the fastest references that an airframe follows."""

import shutil
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

from ftc_jsb.aircraft.description import Aircraft, load_aircraft
from ftc_jsb.errors import AircraftError, TrimError
from ftc_jsb.inner_loop_design.airframe import Airframe, measure
from ftc_jsb.inner_loop_design.numbers_file import Gains, References, write_numbers
from ftc_jsb.inner_loop_design.step_flights import (
    BANK_STEP,
    Response,
    bank_step,
    fly_commands,
    load_factor_step,
    pull,
    response,
)
from ftc_jsb.scenario.schema import Initial
from ftc_jsb.six_dof.weaving import woven_aircraft
from ftc_jsb.units import FOOT

Progress = Callable[[str], None]

# Successive loops a factor of three apart: the inversion a fifth of JSBSim's 200 Hz in rad/s and more,
# body rates a third of it, bank a third of those, load factor a quarter (the airframe's own lag is
# between), sideslip slower than the turn it belongs to.
GAINS = Gains(
    load_factor=3.0, load_factor_integral=1.0, bank=4.0, sideslip=2.0, rate=12.0, inversion=36.0
)
DAMPING = 0.9
LOAD_FACTOR_FREQUENCIES = (
    9.0,
    8.0,
    7.0,
    6.0,
    5.0,
    4.5,
    4.0,
    3.5,
    3.0,
)  # [rad/s], from a quarter of
# the inversion bandwidth down
BANK_FREQUENCIES = (8.0, 7.0, 6.0, 5.0, 4.5, 4.0, 3.5, 3.0, 2.5, 2.0)  # [rad/s]

# Where the search flies: not where the steps of docs/aircraft.md are judged.
AIRSPEEDS = (190.0, 240.0, 290.0)  # [m/s]
ALTITUDES = (1500.0, 4000.0)  # [m]
FUEL = (0.2, 0.8)  # of internal fuel
STEP_TIME = 5.0  # [s]
MARGIN = 1.0  # beyond the test range on each side, for the limits of the load factor command


class Criterion(NamedTuple):
    """What every step of the search must keep: the published criteria, with a margin."""

    overshoot: float  # of the step
    settling: float  # [s] to 5 %; inf = not asked for
    sideslip: float  # [rad]
    following: float  # RMS distance from the reference, of the step


LOAD_FACTOR = Criterion(overshoot=0.08, settling=float("inf"), sideslip=0.03, following=0.15)
BANK = Criterion(overshoot=0.03, settling=1.7, sideslip=0.03, following=0.13)


def design(aircraft: Aircraft, progress: Progress) -> tuple[Airframe, References]:
    """Measure the airframe, then search for the references' frequencies.

    From the highest on, a frequency is taken if at every condition of the grid its steps keep the
    criterion. Load factor first, bank with that.

    Args:
        aircraft: as loaded; an `inner_loop.xml` in its folder is not read.
        progress: told what is being done, a line at a time.

    Raises:
        AircraftError: no trim, a surface that turns nothing, or no frequency that keeps the criterion.
    """
    with tempfile.TemporaryDirectory(prefix="ftc-jsb-") as scratch:
        folder = Path(scratch) / aircraft.name
        shutil.copytree(aircraft.folder, folder)
        airframe = _provisional(aircraft)
        references = References(LOAD_FACTOR_FREQUENCIES[-1], DAMPING, BANK_FREQUENCIES[-1], DAMPING)
        _write(folder, aircraft, airframe, references)
        trial = load_aircraft(str(folder))
        progress("measuring the airframe")
        airframe = measure(trial, woven_aircraft(trial, True))
        _write(folder, aircraft, airframe, references)
        conditions = list(_grid(trial))
        fastest = _fastest(trial, "load-factor", conditions, LOAD_FACTOR, {}, progress)
        chosen = {"ftc/load-factor/frequency": fastest}
        references = references._replace(
            load_factor_frequency=fastest,
            bank_frequency=_fastest(trial, "bank", conditions, BANK, chosen, progress),
        )
    return airframe, references


def write_design(
    path: Path, aircraft: Aircraft, airframe: Airframe, references: References
) -> None:
    """Write the result of `design` as `inner_loop.xml`."""
    low, high = aircraft.flight_test.load_factor
    write_numbers(
        path,
        f"ftc-jsb inner-loop {aircraft.name}",
        airframe,
        references,
        GAINS,
        (low - MARGIN, high + MARGIN),
    )


def _write(folder: Path, aircraft: Aircraft, airframe: Airframe, references: References) -> None:
    write_design(folder / "inner_loop.xml", aircraft, airframe, references)


def _provisional(aircraft: Aircraft) -> Airframe:
    """Numbers that only let the aircraft be woven: the airframe is measured with the loop disengaged."""
    surfaces: dict[str, tuple[float, ...]] = {
        "elevator": (-0.01,),
        "aileron": (0.01,),
        "rudder": (-0.01,),
    }
    return Airframe((1.0,), (3.0,), surfaces, (1.0,), dict.fromkeys(surfaces, 1.0))


def _grid(aircraft: Aircraft) -> Iterator[tuple[Initial, float]]:
    low, high = aircraft.flight_test.airspeed
    for airspeed in AIRSPEEDS:
        for altitude in ALTITUDES:
            for fuel in FUEL:
                if low <= airspeed <= high:
                    yield Initial(airspeed=airspeed, altitude=altitude), fuel


def _fastest(
    aircraft: Aircraft,
    axis: str,
    conditions: list[tuple[Initial, float]],
    criterion: Criterion,
    numbers: dict[str, float],
    progress: Progress,
) -> float:
    ladder = LOAD_FACTOR_FREQUENCIES if axis == "load-factor" else BANK_FREQUENCIES
    remaining = list(conditions)
    broken = ""
    for frequency in ladder:
        for condition in remaining:
            try:
                judged, sideslip = fly_step(
                    aircraft, axis, *condition, {**numbers, f"ftc/{axis}/frequency": frequency}
                )
            except TrimError:  # too heavy, too slow or too fast for this aircraft
                conditions = [other for other in conditions if other != condition]
                continue
            broken = _broken(judged, sideslip, criterion)
            if broken:
                where = f"{condition[0].airspeed:g} m/s, {condition[0].altitude:g} m, fuel {condition[1]:g}"
                progress(f"{axis} {frequency:g} rad/s: {broken} at {where}")
                # the hardest condition first: what broke one frequency most likely breaks the next
                remaining = [condition, *(c for c in conditions if c != condition)]
                break
        else:
            progress(f"{axis} {frequency:g} rad/s: kept at all {len(conditions)} conditions")
            return frequency
    raise AircraftError(
        f"aircraft {aircraft.name!r}: no {axis} reference down to {ladder[-1]:g} rad/s is followed: "
        f"{broken}"
    )


def fly_step(
    aircraft: Aircraft,
    axis: str,
    initial: Initial,
    fuel_fraction: float,
    numbers: dict[str, float] | None = None,
) -> tuple[Response, float]:
    """A step of `load-factor` or `bank` and its largest sideslip [rad].

    Raises:
        TrimError: no trim there.
    """
    if axis == "bank":
        flown = fly_commands(aircraft, initial, fuel_fraction, bank_step, STEP_TIME, numbers)
        value, reference, last = flown.record["bank_angle"], flown.bank_reference, BANK_STEP
        first = 0.0
    else:
        at_start = fly_commands(aircraft, initial, fuel_fraction, load_factor_step(1.0), 0.02)
        most = pull(
            aircraft.flight_test.lift_coefficient_max, reference_area(aircraft), at_start.record[0]
        )
        flown = fly_commands(
            aircraft, initial, fuel_fraction, load_factor_step(most), STEP_TIME, numbers
        )
        value, reference = flown.record["load_factor"], flown.load_factor_reference
        first, last = 1.0, most
    judged = response(flown.record["time"], value, reference, first, last)
    return judged, float(abs(flown.record["sideslip"]).max())


def reference_area(aircraft: Aircraft) -> float:
    """Wing area [m^2] of the installed model."""
    from ftc_jsb.six_dof.trim import load

    fdm = load(aircraft, woven_aircraft(aircraft, True), 0.005)
    return float(fdm["metrics/Sw-sqft"]) * FOOT**2


def _broken(judged: Response, sideslip: float, criterion: Criterion) -> str:
    """Which part of the criterion is not kept; empty if all is."""
    if judged.overshoot > criterion.overshoot:
        return f"overshoot {100.0 * judged.overshoot:.1f} %"
    if judged.settling > criterion.settling:
        return f"settled after {judged.settling:.2f} s"
    if sideslip > criterion.sideslip:
        return f"sideslip {sideslip:.3f} rad"
    if judged.following > criterion.following:
        return f"{100.0 * judged.following:.1f} % RMS from the reference"
    return ""
