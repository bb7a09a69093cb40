"""The inner loop's numbers by a repeatable search: the fastest references that an airframe follows."""

import shutil
import tempfile
from pathlib import Path
from typing import NamedTuple

from ftc_jsb.aircraft.description import Aircraft, load_aircraft
from ftc_jsb.aircraft.test_range import design_airspeeds, design_altitudes, mach_numbers
from ftc_jsb.inner_loop_design.airframe import Airframe, measure
from ftc_jsb.inner_loop_design.handling import CLASSES, Handling, class_of
from ftc_jsb.inner_loop_design.numbers_file import Gains, References, feedback, write_numbers
from ftc_jsb.inner_loop_design.reference_search import (
    NotFollowedError,
    Progress,
    axes,
    fastest_reference,
)
from ftc_jsb.point_mass.atmosphere import standard_atmosphere
from ftc_jsb.six_dof.weaving.trial import vouch_for
from ftc_jsb.six_dof.weaving.woven_aircraft import woven_aircraft
from ftc_jsb.units import FOOT, POUND_FORCE

# Successive loops a factor of three apart: the inversion a fifth of JSBSim's 200 Hz in rad/s and more,
# body rates a third of it, bank a third of those, load factor a quarter (the airframe's own lag is
# between), sideslip slower than the turn it belongs to.
GAINS = {
    "load_factor": 3.0,
    "load_factor_integral": 1.0,
    "bank": 4.0,
    "sideslip": 2.0,
    "rate": 12.0,
    "inversion": 36.0,
}
GAIN_SCALES = (1.0, 0.6, 0.4, 0.25)  # tried in this order
MOST_FULL_PRESSURE = 800.0  # [psf]
POUND_PER_SQUARE_FOOT = POUND_FORCE / FOOT**2  # [Pa]
DAMPING = 0.9
MARGIN = 1.0  # beyond the test range on each side, for the limits of the load factor command


class Design(NamedTuple):
    """The numbers of an inner loop."""

    airframe: Airframe
    references: References
    gains: Gains


def design(aircraft: Aircraft, progress: Progress) -> Design:
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
        folder = Path(scratch) / aircraft.folder.name
        shutil.copytree(aircraft.folder, folder)
        write_provisional(folder / "inner_loop.xml", aircraft)
        trial = load_aircraft(str(folder))
        handling = CLASSES[class_of(trial)]
        progress(f"class {class_of(trial)} of MIL-F-8785C; measuring the airframe")
        woven = woven_aircraft(trial, True)
        vouch_for(folder)
        airframe = measure(trial, woven, mach_numbers(trial.flight_test))
        slowest = References(
            handling.load_factor_frequencies[-1], DAMPING, handling.bank_frequencies[-1], DAMPING
        )
        result = Design(airframe, slowest, gains(trial, handling, 1.0))
        write_design(folder / "inner_loop.xml", aircraft, result)
        return _searched(trial, result, handling, progress)


def _searched(trial: Aircraft, result: Design, handling: Handling, progress: Progress) -> Design:
    """The fastest references with the highest gains with which there are any."""
    load_factor, bank = axes(handling)
    for scale in GAIN_SCALES:
        found = gains(trial, handling, scale)
        chosen = {f"ftc/gain/{name.replace('_', '-')}": value for name, value in feedback(found)}
        try:
            fastest = fastest_reference(trial, load_factor, chosen, progress)
            chosen["ftc/load-factor/frequency"] = fastest
            rolled = fastest_reference(trial, bank, chosen, progress)
        except NotFollowedError as error:
            if scale == GAIN_SCALES[-1]:
                raise
            progress(f"gains times {scale:g}: {error}")
            continue
        return result._replace(
            references=result.references._replace(
                load_factor_frequency=fastest, bank_frequency=rolled
            ),
            gains=found,
        )
    raise AssertionError


def write_design(path: Path, aircraft: Aircraft, result: Design) -> None:
    """Write the result of `design` as `inner_loop.xml`."""
    low, high = aircraft.flight_test.load_factor
    write_numbers(
        path,
        f"ftc-jsb inner-loop {aircraft.name}",
        aircraft.jsbsim_model,
        result.airframe,
        result.references,
        result.gains,
        (low - MARGIN, high + MARGIN),
    )


def gains(aircraft: Aircraft, handling: Handling, scale: float) -> Gains:
    """Feedback of an aircraft's inner loop.

    Args:
        aircraft: as loaded.
        handling: of its class.
        scale: of all but the inversion: a weak elevator's own lift bears no more.

    Raises:
        AircraftError: the test range has no room to design in.
    """
    highest = design_altitudes(aircraft.flight_test)[1]
    least = min(design_airspeeds(aircraft))
    pressure = 0.5 * standard_atmosphere(highest)[0] * least**2 / POUND_PER_SQUARE_FOOT
    scaled = {name: scale * value for name, value in GAINS.items()}
    return Gains(
        **(scaled | {"inversion": GAINS["inversion"]}),
        full_pressure=min(handling.full_pressure * pressure, MOST_FULL_PRESSURE),
    )


def write_provisional(path: Path, aircraft: Aircraft) -> None:
    """Write an `inner_loop.xml` that only lets an aircraft be woven, for flight with it disengaged."""
    surfaces: dict[str, tuple[float, ...]] = {
        "elevator": (-0.01,),
        "aileron": (0.01,),
        "rudder": (-0.01,),
    }
    airframe = Airframe((1.0,), (3.0,), surfaces, (1.0,), dict.fromkeys(surfaces, 1.0))
    references = References(1.0, DAMPING, 1.0, DAMPING)
    full = Gains(**GAINS, full_pressure=MOST_FULL_PRESSURE)
    write_design(path, aircraft, Design(airframe, references, full))
