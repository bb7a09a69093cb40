"""The inner loop's numbers by a repeatable search: the fastest references that an airframe follows."""

import shutil
import tempfile
from pathlib import Path

from ftc_jsb.aircraft.description import Aircraft, load_aircraft
from ftc_jsb.inner_loop_design.airframe import Airframe, measure
from ftc_jsb.inner_loop_design.numbers_file import Gains, References, write_numbers
from ftc_jsb.inner_loop_design.reference_search import (
    BANK,
    LOAD_FACTOR,
    Progress,
    fastest_reference,
    search_grid,
)
from ftc_jsb.six_dof.weaving.woven_aircraft import woven_aircraft

# Successive loops a factor of three apart: the inversion a fifth of JSBSim's 200 Hz in rad/s and more,
# body rates a third of it, bank a third of those, load factor a quarter (the airframe's own lag is
# between), sideslip slower than the turn it belongs to.
GAINS = Gains(
    load_factor=3.0, load_factor_integral=1.0, bank=4.0, sideslip=2.0, rate=12.0, inversion=36.0
)
DAMPING = 0.9
MARGIN = 1.0  # beyond the test range on each side, for the limits of the load factor command


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
        references = _slowest()
        _write(folder, aircraft, airframe, references)
        trial = load_aircraft(str(folder))
        progress("measuring the airframe")
        airframe = measure(trial, woven_aircraft(trial, True))
        _write(folder, aircraft, airframe, references)
        conditions = list(search_grid(trial))
        fastest = fastest_reference(trial, LOAD_FACTOR, conditions, {}, progress)
        chosen = {"ftc/load-factor/frequency": fastest}
        references = references._replace(
            load_factor_frequency=fastest,
            bank_frequency=fastest_reference(trial, BANK, conditions, chosen, progress),
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


def _slowest() -> References:
    return References(LOAD_FACTOR.frequencies[-1], DAMPING, BANK.frequencies[-1], DAMPING)


def _provisional(aircraft: Aircraft) -> Airframe:
    """Numbers that only let the aircraft be woven: the airframe is measured with the loop disengaged."""
    surfaces: dict[str, tuple[float, ...]] = {
        "elevator": (-0.01,),
        "aileron": (0.01,),
        "rudder": (-0.01,),
    }
    return Airframe((1.0,), (3.0,), surfaces, (1.0,), dict.fromkeys(surfaces, 1.0))
